/**
 * A segmentation and the steps that correct it, which can be taken back and brought again.
 */
#ifndef Corrections_h
#define Corrections_h

#include "Inputs.h"
#include "Scene.h"

#include <vtkFlipFreeSegmentation.h>
#include <vtkNew.h>

#include <string>
#include <vector>

/// What points say of their places.
struct Meaning
{
  const char* Words;
  const double* Color;
  void (vtkFlipFreeSegmentation::*Add)(double, double, double);

  /// Null for points that no part of the organ follows.
  double (vtkFlipFreeSegmentation::*Preview)(double, double, double, vtkImageData*);
};

extern const Meaning Outside;
extern const Meaning Inside;
extern const Meaning Boundary;

/// A click, a stroke, or an answer.
struct Step
{
  const Meaning* What;
  std::vector<Scene::Vector> Places;
};

/// A part of which the segmentation is not sure.
struct Question
{
  Scene::Vector Place;
  double Volume; ///< ml
  bool Included;
};

class Corrections
{
public:
  explicit Corrections(const Inputs& inputs);

  /// A step that cannot be obeyed is none: false, the result stays, and GetError() says why.
  bool Do(const Step& step);

  /// False if there is nothing to take back.
  bool Undo();

  /// False if nothing has been taken back.
  bool Redo();

  /// The milliliters, and the voxels, that a click would change; -1 if it cannot be obeyed.
  double Preview(const Meaning& what, const Scene::Vector& place, vtkImageData* changed);

  std::vector<Step> GetDone() const;
  std::vector<Question> GetQuestions() const;
  const std::string& GetError() const { return this->Error; }

  /// One object, into which each new result is copied.
  vtkPolyData* GetSurface() { return this->Surface; }
  vtkFlipFreeSegmentation* GetFilter() { return this->Filter; }

private:
  void Add(const Step& step);
  void Remove(const Step& step);
  bool Segment();
  void NoteError(vtkObject* sender, unsigned long event, void* words);

  vtkNew<vtkFlipFreeSegmentation> Filter;
  vtkNew<vtkPolyData> Surface;
  std::vector<Step> Steps; // those beyond NumberDone have been taken back
  std::size_t NumberDone = 0;
  std::string Error; // of the last run, if any
};

#endif
