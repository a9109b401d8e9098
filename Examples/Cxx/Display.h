/**
 * Whether there is a display to draw with.
 */
#ifndef Display_h
#define Display_h

/// Ends the program with 1, saying so, where there is none: VTK would abort it, and only after the
/// organ has been segmented.
void RequireDisplay();

#endif
