"""A user at the screen: moves the mouse, presses keys, and takes pictures, through X11's test extension."""

import ctypes
import os
import time

from PIL import ImageGrab


class WindowAttributes(ctypes.Structure):
    """XWindowAttributes, of which only the beginning and the state are looked at."""

    _fields_ = [("x", ctypes.c_int), ("y", ctypes.c_int), ("width", ctypes.c_int), ("height", ctypes.c_int),
                ("border", ctypes.c_int), ("depth", ctypes.c_int), ("visual", ctypes.c_void_p),
                ("root", ctypes.c_ulong), ("between", ctypes.c_byte * 52), ("map_state", ctypes.c_int),
                ("rest", ctypes.c_byte * 64)]


@ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_void_p)
def go_on(_display, _error):
    """A window may be gone by the time it is asked for its size; X11's own handler would end the program."""
    return 0


class Desk:
    def __init__(self):
        self.x11 = ctypes.CDLL("libX11.so.6")
        self.xtst = ctypes.CDLL("libXtst.so.6")
        self.x11.XOpenDisplay.restype = ctypes.c_void_p
        self.x11.XDefaultRootWindow.restype = ctypes.c_ulong
        self.x11.XStringToKeysym.restype = ctypes.c_ulong
        self.x11.XSetErrorHandler(go_on)
        self.display = ctypes.c_void_p(self.x11.XOpenDisplay(None))
        if not self.display:
            raise RuntimeError("No X11 display " + os.environ.get("DISPLAY", "(DISPLAY is not set)"))

    def windows(self):
        """The windows that are seen, the greatest first, as (width, height, id)."""
        root, parent, count = ctypes.c_ulong(), ctypes.c_ulong(), ctypes.c_uint()
        children = ctypes.POINTER(ctypes.c_ulong)()
        self.x11.XQueryTree(self.display, ctypes.c_ulong(self.x11.XDefaultRootWindow(self.display)),
                            ctypes.byref(root), ctypes.byref(parent), ctypes.byref(children), ctypes.byref(count))
        found = []
        for index in range(count.value):
            shape = WindowAttributes()
            known = self.x11.XGetWindowAttributes(self.display, ctypes.c_ulong(children[index]), ctypes.byref(shape))
            if known and shape.map_state == 2:
                found.append((shape.width, shape.height, children[index]))
        if count.value:
            self.x11.XFree(children)
        return sorted(found, reverse=True)

    def fill_screen(self, window, width, height):
        self.x11.XMoveResizeWindow(self.display, ctypes.c_ulong(window), 0, 0, width, height)
        self.settle(1)

    def focus(self, window):
        """Gives a window the keyboard, as a window manager would."""
        self.x11.XSetInputFocus(self.display, ctypes.c_ulong(window), 1, ctypes.c_ulong(0))
        self.settle()

    def settle(self, seconds=0.3):
        self.x11.XSync(self.display, 0)
        time.sleep(seconds)

    def move(self, x, y):
        self.xtst.XTestFakeMotionEvent(self.display, -1, int(x), int(y), ctypes.c_ulong(0))
        self.settle(0.1)

    def drag(self, places):
        """Holds the left button from the first of these places to the last."""
        self.move(*places[0])
        self.xtst.XTestFakeButtonEvent(self.display, 1, 1, ctypes.c_ulong(0))
        try:
            for place in places[1:]:
                self.move(*place)
        finally:
            self.xtst.XTestFakeButtonEvent(self.display, 1, 0, ctypes.c_ulong(0))
            self.settle()

    def key(self, name, *held):
        """Presses a key, as `key("z", "Control_L")`."""
        codes = [self.x11.XKeysymToKeycode(self.display, ctypes.c_ulong(self.x11.XStringToKeysym(key.encode())))
                 for key in (*held, name)]
        for code in codes:
            self.xtst.XTestFakeKeyEvent(self.display, code, 1, ctypes.c_ulong(0))
        for code in reversed(codes):
            self.xtst.XTestFakeKeyEvent(self.display, code, 0, ctypes.c_ulong(0))
        self.settle()

    def picture(self, width, height):
        return ImageGrab.grab(bbox=(0, 0, width, height), xdisplay=os.environ["DISPLAY"])
