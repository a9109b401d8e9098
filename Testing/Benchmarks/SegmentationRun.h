/**
 * Seconds per stage of a run of the segmentation.
 */
#ifndef SegmentationRun_h
#define SegmentationRun_h

class vtkFlipFreeSegmentation;
class vtkTable;

struct StageSeconds
{
  double Smoothing = 0; ///< the region, its noise, and the prefilter
  double Feature = 0;
  double Deformation = 0; ///< all iterations, refinements, and the check at the end
  double Labels = 0;

  int Iterations = 0; ///< the sums over these of
  double Search = 0;
  double Flips = 0; ///< and propagation
  double Solve = 0;
  double Guard = 0;
};

StageSeconds StageSecondsOf(vtkFlipFreeSegmentation* filter);

double SumOfColumn(vtkTable* table, const char* name);

#endif
