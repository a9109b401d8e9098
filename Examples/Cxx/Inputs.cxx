#include "Inputs.h"

#include "Display.h"

#include <vtkMedicalImageReader.h>
#include <vtkNew.h>
#include <vtkPhantomSource.h>

#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <vector>

namespace
{

std::string UsageOf(const char* program)
{
  return std::string("Usage: ") + program +
    " [FILE --seed X Y Z --radius R] [--picture PNG] [--start STL]\n"
    "FILE may be a folder of DICOM files; without it, the built-in phantom serves.\n"
    "The seed sphere lies in the organ: its center and radius in millimeters, LPS.\n"
    "--picture draws what came out; --start is for StartFromAnotherSurface.\n";
}

[[noreturn]] void Refuse(const char* program, const std::string& why)
{
  std::cerr << why << "\n" << UsageOf(program);
  std::exit(2);
}

void UsePhantom(Inputs& inputs)
{
  vtkNew<vtkPhantomSource> phantom;
  phantom->SetShapeToAbdomen();
  phantom->Update();
  inputs.Image = phantom->GetOutput();
  double ball[4];
  phantom->GetSeed(vtkPhantomSource::LIVER, ball);
  inputs.Seed = { ball[0], ball[1], ball[2] };
  inputs.Radius = ball[3];
}

void ReadFile(const std::string& name, Inputs& inputs)
{
  vtkNew<vtkMedicalImageReader> reader;
  reader->SetFileName(name.c_str());
  reader->Update(); // tells by itself why it could not
  if (reader->GetErrorCode() != 0)
  {
    std::exit(1);
  }
  inputs.Image = reader->GetOutput();
}

} // namespace

Inputs ReadInputs(int argc, char* argv[])
{
  Inputs inputs;
  std::string file;
  bool hasSeed = false;
  const std::vector<std::string> words(argv + 1, argv + argc);
  try
  {
    for (std::size_t i = 0; i < words.size(); ++i)
    {
      if (words[i] == "--help" || words[i] == "-h")
      {
        std::cout << UsageOf(argv[0]);
        std::exit(0);
      }
      if (words[i] == "--seed")
      {
        hasSeed = true;
        for (double& coordinate : inputs.Seed)
        {
          coordinate = std::stod(words.at(++i));
        }
      }
      else if (words[i] == "--radius")
      {
        inputs.Radius = std::stod(words.at(++i));
      }
      else if (words[i] == "--picture")
      {
        inputs.Picture = words.at(++i);
      }
      else if (words[i] == "--start")
      {
        inputs.Start = words.at(++i);
      }
      else if (file.empty() && !words[i].empty() && words[i].front() != '-')
      {
        file = words[i];
      }
      else
      {
        Refuse(argv[0], "What is " + words[i] + "?");
      }
    }
  }
  catch (const std::logic_error&) // of std::stod and at
  {
    Refuse(argv[0], "An option lacks its value, or it is not a number.");
  }
  if (!inputs.Picture.empty())
  {
    RequireDisplay();
  }
  if (file.empty())
  {
    if (hasSeed || inputs.Radius != 0)
    {
      Refuse(argv[0], "--seed and --radius go with an image; the phantom has a seed of its own.");
    }
    UsePhantom(inputs);
  }
  else if (!hasSeed || inputs.Radius <= 0)
  {
    Refuse(argv[0], "An image needs --seed X Y Z and --radius R.");
  }
  else
  {
    ReadFile(file, inputs);
  }
  return inputs;
}
