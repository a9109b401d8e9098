/**
 * The accuracy of each row and the hash of its surface, kept in a table (case, organ, Dice, hash),
 * and what a change of the code does to them.
 */
#ifndef AccuracyGate_h
#define AccuracyGate_h

#include <string>
#include <vector>

class vtkPolyData;

struct GateRow
{
  std::string Case;
  std::string Organ;
  double Dice = 0;
  std::string Hash; ///< of the surface; empty without one
};

/// Of the bits of the coordinates, and of the quads.
std::string HashOf(vtkPolyData* surface);

/// Throws std::runtime_error where the file cannot be read.
std::vector<GateRow> ReadGate(const std::string& file);

/// Throws std::runtime_error where the file cannot be written.
void WriteGate(const std::string& file, const std::vector<GateRow>& rows);

/// Prints what has changed: surfaces, and Dice by more than 0.002. Returns whether the change may
/// pass: each row that was measured is in the table and loses no more than 0.02, and the median of
/// no organ more than 0.003.
bool PassesGate(const std::vector<GateRow>& before, const std::vector<GateRow>& after);

#endif
