#include "AskQuestions.h"

#include "Messages.h"
#include "Run.h"

#include "TextWords.h"

#include "vtkTable.h"
#include "vtkVariant.h"

#include <cmath>
#include <cstdio>
#include <iostream>
#include <optional>
#include <string>

namespace Command
{
namespace
{

/// Python's package has the same words (_questions.py).
std::string QuestionText(vtkTable* questions, vtkIdType row)
{
  const auto number = [questions, row](const char* column)
  { return questions->GetValueByName(row, column).ToDouble(); };
  const auto millimeters = [&number](const char* column) { return std::lrint(number(column)); };
  char text[200];
  std::snprintf(text, sizeof(text),
    "Is the part of %.0f ml at (%ld, %ld, %ld) mm organ? It is %s. [y/n, Enter: skip] ",
    number("volume_ml"), millimeters("x"), millimeters("y"), millimeters("z"),
    number("included") != 0 ? "included" : "left out");
  return text;
}

/// Asks again until the answer is one; none at the end of the input.
std::optional<std::string> AnswerTo(const std::string& question)
{
  std::string answer;
  do
  {
    WriteToUser(question);
    if (!std::getline(std::cin, answer))
    {
      WriteToUser("\n");
      return std::nullopt;
    }
    answer = FlipFree::InSmallLetters(answer);
  } while (!answer.empty() && answer != "y" && answer != "yes" && answer != "n" && answer != "no");
  return answer;
}

} // namespace

std::vector<CorrectionPoint> AskQuestions(vtkTable* questions)
{
  std::vector<CorrectionPoint> points;
  for (vtkIdType row = 0; row < questions->GetNumberOfRows(); ++row)
  {
    const std::optional<std::string> answer = AnswerTo(QuestionText(questions, row));
    StopIfInterrupted();
    if (!answer)
    {
      break;
    }
    if (!answer->empty())
    {
      CorrectionPoint point;
      point.Kind = answer->front() == 'y' ? FlipFree::ConstraintKind::Inside
                                          : FlipFree::ConstraintKind::Outside;
      const char* const axes[3] = { "x", "y", "z" };
      for (int axis = 0; axis < 3; ++axis)
      {
        point.Place[axis] = questions->GetValueByName(row, axes[axis]).ToDouble();
      }
      points.push_back(point);
    }
  }
  return points;
}

} // namespace Command
