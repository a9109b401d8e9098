/**
 * A window in which clicks, strokes and answers correct a segmentation; CorrectByClicking.cxx says
 * how.
 */
#ifndef CorrectionWindow_h
#define CorrectionWindow_h

#include "Corrections.h"
#include "ThreeViews.h"

#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkRenderWindowInteractor.h>

/// What a click means, by the key that says so.
struct Mode
{
  char Key;
  const char* Words;
  const Meaning* What; ///< null if it only moves the slices

  /// Whether parts of the organ come or go, which strokes paint and previews show.
  bool IsOfParts() const { return this->What && this->What->Preview; }
};

class CorrectionWindow
{
public:
  explicit CorrectionWindow(const Inputs& inputs);

  Corrections& GetCorrections() { return this->Organ; }
  ThreeViews& GetViews() { return this->Views; }
  vtkRenderWindowInteractor* GetInteractor() { return this->Interactor; }

  /// In words.
  const std::string& GetPreview() const { return this->Preview; }

private:
  void Press();
  void Move();
  void Release();
  void TurnWheel(vtkObject* sender, unsigned long event, void*);
  void TakeKey();
  void Do(const Step& step);
  void GoToQuestion();
  void Answer(bool isPart);
  void Say(const std::string& words);
  void ShowWords();
  void ShowMarks();
  void ShowPreview();

  Corrections Organ;
  ThreeViews Views;
  vtkNew<vtkRenderWindowInteractor> Interactor;
  vtkNew<vtkInteractorStyleTrackballCamera> Style;
  const Mode* Now;
  std::string Words;   // about the last step
  std::string Preview; // of a click where the mouse is
  std::vector<Question> Questions;
  std::size_t Asked = 0; // the question that keys answer
  bool HasGone = false;  // whether the slices have gone to it
  int Pressed[2] = { 0, 0 };
  int PressedSlice = -1;
  bool IsHeld = false;               // the button
  bool IsPreviewStale = false;       // since the mouse has moved, or the organ changed
  bool HasMoved = false;             // the mouse, since the timer rang
  std::vector<Scene::Vector> Stroke; // that is being painted
};

#endif
