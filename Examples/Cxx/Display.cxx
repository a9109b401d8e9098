#include "Display.h"

#ifdef EXAMPLES_VTK_ON_X11
#include <X11/Xlib.h>
#endif

#include <cstdlib>
#include <iostream>

void RequireDisplay()
{
#ifdef EXAMPLES_VTK_ON_X11
  Display* display = XOpenDisplay(nullptr);
  if (!display)
  {
    std::cerr << "There is no display to draw with: start the program by 'xvfb-run -a ...'.\n";
    std::exit(1);
  }
  XCloseDisplay(display);
#endif
}
