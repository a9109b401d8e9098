/**
 * What the examples segment: a file of the user's, or else the built-in abdomen phantom's liver.
 */
#ifndef Inputs_h
#define Inputs_h

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

#include <array>
#include <string>

struct Inputs
{
  vtkSmartPointer<vtkImageData> Image;
  std::array<double, 3> Seed{}; // within the organ, LPS millimeters
  double Radius = 0;
  std::string Picture; // to draw, if any
  std::string Start;   // STL file of another surface to start from, if any
};

/// Reads `[FILE --seed X Y Z --radius R] [--picture PNG] [--start STL]`; ends the program, saying
/// why, where that will not do, and with the usage for --help.
Inputs ReadInputs(int argc, char* argv[]);

#endif
