#include "Corrections.h"

#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkTable.h>
#include <vtkVariant.h>

namespace
{

constexpr double Red[3] = { 0.9, 0.1, 0.1 };
constexpr double Green[3] = { 0.3, 0.8, 0.35 };

} // namespace

const Meaning Outside{ "outside the organ", Red, &vtkFlipFreeSegmentation::AddOutsidePoint,
  &vtkFlipFreeSegmentation::PreviewOutsidePoint };
const Meaning Inside{ "inside the organ", Green, &vtkFlipFreeSegmentation::AddInsidePoint,
  &vtkFlipFreeSegmentation::PreviewInsidePoint };
const Meaning Boundary{ "on its boundary", Scene::Blue, &vtkFlipFreeSegmentation::AddBoundaryPoint,
  nullptr };

Corrections::Corrections(const Inputs& inputs)
{
  this->Filter->SetInputData(inputs.Image);
  this->Filter->SetSeedCenter(inputs.Seed.data());
  this->Filter->SetSeedRadius(inputs.Radius);
  this->Filter->KeepForCorrectionsOn(); // a correction then takes a third of the time
  this->Filter->AddObserver(vtkCommand::ErrorEvent, this, &Corrections::NoteError);
  this->Filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this, &Corrections::NoteError);
  this->Segment();
}

/// Runs the method with the points there are.
bool Corrections::Segment()
{
  this->Error.clear();
  this->Filter->Update();
  this->Surface->ShallowCopy(this->Filter->GetSurface());
  return this->Error.empty();
}

/// The filter's own words, without the place in the source that VTK puts before them. The pipeline
/// says a second time that the filter has failed.
void Corrections::NoteError(vtkObject*, unsigned long, void* words)
{
  if (!this->Error.empty())
  {
    return;
  }
  const std::string text = static_cast<const char*>(words);
  const std::size_t start = text.find("): ");
  this->Error = start == std::string::npos ? text : text.substr(start + 3);
  this->Error.erase(this->Error.find_last_not_of('\n') + 1);
}

void Corrections::Add(const Step& step)
{
  for (const auto& [x, y, z] : step.Places)
  {
    (this->Filter->*step.What->Add)(x, y, z);
  }
}

void Corrections::Remove(const Step& step)
{
  for (std::size_t count = step.Places.size(); count > 0; --count)
  {
    this->Filter->RemoveLastCorrection();
  }
}

bool Corrections::Do(const Step& step)
{
  this->Add(step);
  if (this->Segment())
  {
    this->Steps.resize(this->NumberDone); // what was taken back before is gone
    this->Steps.push_back(step);
    ++this->NumberDone;
    return true;
  }
  const std::string why = this->Error;
  this->Remove(step);
  this->Segment();
  this->Error = why;
  return false;
}

bool Corrections::Undo()
{
  if (this->NumberDone == 0)
  {
    return false;
  }
  this->Remove(this->Steps[--this->NumberDone]);
  this->Segment();
  return true;
}

bool Corrections::Redo()
{
  if (this->NumberDone == this->Steps.size())
  {
    return false;
  }
  this->Add(this->Steps[this->NumberDone++]);
  this->Segment();
  return true;
}

double Corrections::Preview(const Meaning& what, const Scene::Vector& place, vtkImageData* changed)
{
  return (this->Filter->*what.Preview)(place[0], place[1], place[2], changed);
}

std::vector<Step> Corrections::GetDone() const
{
  return { this->Steps.begin(), this->Steps.begin() + this->NumberDone };
}

std::vector<Question> Corrections::GetQuestions() const
{
  vtkTable* const table = this->Filter->GetQuestions();
  std::vector<Question> questions;
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    const auto number = [table, row](const char* column)
    { return table->GetValueByName(row, column).ToDouble(); };
    questions.push_back(
      { { number("x"), number("y"), number("z") }, number("volume_ml"), number("included") != 0 });
  }
  return questions;
}
