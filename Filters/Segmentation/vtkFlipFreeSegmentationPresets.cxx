// The presets of vtkFlipFreeSegmentation, and its printing: long lists, and nothing else.
#include "vtkFlipFreeSegmentation.h"

#include "vtkIndent.h"

void vtkFlipFreeSegmentation::UseDefaultParameters()
{
  this->Resolution = 32;
  this->Levels = 3;
  this->MaximumIterations = 40;
  this->DistanceTolerance = 0.1;
  this->ChangeTolerance = 0.02;
  this->DiffusionIterations = 5;
  this->DiffusionEquation = 0;
  this->MaximumComponents = 3;
  this->MinimumComponentWeight = 0.15;
  this->ForegroundMass = 0.95;
  this->FeatureThreshold = 0;
  this->NoiseWidening = 1;
  this->LeakControl = true;
  this->ClosingRadius = 1.5;
  this->OpeningScale = 0.4;
  this->ReestimateIntensities = true;
  this->SearchScale = 1.6;
  this->SearchDistance = 0;
  this->RunLength = 2;
  this->RunVoxels = 4;
  this->SearchInward = true;
  this->EdgeWindow = 3;
  this->ImageBoundaryDistance = 12;
  this->NormalSmoothingIterations = 2;
  this->OutlierStandardDeviations = 3;
  this->MaximumDisplacement = 8;
  this->AvoidFlips = true;
  this->FlipThreshold = 0.3;
  this->PropagationIterations = 40;
  this->PositionWeight = 0.3;
  this->UniformWeight = 1;
  this->Fairing = 0;
  this->Guard = true;
  this->Modified();
}

void vtkFlipFreeSegmentation::UsePublishedParameters()
{
  this->UseDefaultParameters();
  this->Levels = 1;
  this->MaximumIterations = 150;
  this->MinimumComponentWeight = 0;
  this->NoiseWidening = 0;
  this->LeakControl = false;
  this->ReestimateIntensities = false;
  this->SearchDistance = 40;
  this->RunLength = 0;
  this->RunVoxels = 4;
  this->SearchInward = false;
  this->EdgeWindow = 0;
  this->ImageBoundaryDistance = 0;
  this->NormalSmoothingIterations = 0;
  this->OutlierStandardDeviations = 0;
  this->MaximumDisplacement = 0;
  this->Guard = false;
}

void vtkFlipFreeSegmentation::UseNaiveParameters()
{
  this->UsePublishedParameters();
  this->AvoidFlips = false;
}

void vtkFlipFreeSegmentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SeedCenter: (" << this->SeedCenter[0] << ", " << this->SeedCenter[1] << ", "
     << this->SeedCenter[2] << ")\n";
  os << indent << "SeedRadius: " << this->SeedRadius << "\n";
  os << indent << "StartScale: " << this->StartScale << "\n";
  os << indent << "StartCenterOffset: (" << this->StartCenterOffset[0] << ", "
     << this->StartCenterOffset[1] << ", " << this->StartCenterOffset[2] << ")\n";
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "Levels: " << this->Levels << "\n";
  os << indent << "MaximumIterations: " << this->MaximumIterations << "\n";
  os << indent << "DistanceTolerance: " << this->DistanceTolerance << "\n";
  os << indent << "ChangeTolerance: " << this->ChangeTolerance << "\n";
  os << indent << "Reach: " << this->Reach << "\n";
  os << indent << "DiffusionIterations: " << this->DiffusionIterations << "\n";
  os << indent << "DiffusionEquation: " << this->DiffusionEquation << "\n";
  os << indent << "MaximumComponents: " << this->MaximumComponents << "\n";
  os << indent << "MinimumComponentWeight: " << this->MinimumComponentWeight << "\n";
  os << indent << "ForegroundMass: " << this->ForegroundMass << "\n";
  os << indent << "FeatureThreshold: " << this->FeatureThreshold << "\n";
  os << indent << "NoiseWidening: " << this->NoiseWidening << "\n";
  os << indent << "LeakControl: " << this->LeakControl << "\n";
  os << indent << "ClosingRadius: " << this->ClosingRadius << "\n";
  os << indent << "OpeningScale: " << this->OpeningScale << "\n";
  os << indent << "ReestimateIntensities: " << this->ReestimateIntensities << "\n";
  os << indent << "SearchScale: " << this->SearchScale << "\n";
  os << indent << "SearchDistance: " << this->SearchDistance << "\n";
  os << indent << "RunLength: " << this->RunLength << "\n";
  os << indent << "RunVoxels: " << this->RunVoxels << "\n";
  os << indent << "SearchInward: " << this->SearchInward << "\n";
  os << indent << "EdgeWindow: " << this->EdgeWindow << "\n";
  os << indent << "ImageBoundaryDistance: " << this->ImageBoundaryDistance << "\n";
  os << indent << "NormalSmoothingIterations: " << this->NormalSmoothingIterations << "\n";
  os << indent << "OutlierStandardDeviations: " << this->OutlierStandardDeviations << "\n";
  os << indent << "MaximumDisplacement: " << this->MaximumDisplacement << "\n";
  os << indent << "AvoidFlips: " << this->AvoidFlips << "\n";
  os << indent << "FlipThreshold: " << this->FlipThreshold << "\n";
  os << indent << "PropagationIterations: " << this->PropagationIterations << "\n";
  os << indent << "PositionWeight: " << this->PositionWeight << "\n";
  os << indent << "UniformWeight: " << this->UniformWeight << "\n";
  os << indent << "Fairing: " << this->Fairing << "\n";
  os << indent << "Guard: " << this->Guard << "\n";
  os << indent << "LabelValue: " << this->LabelValue << "\n";
  os << indent << "KeepHistory: " << this->KeepHistory << "\n";
  os << indent << "StopReason: " << this->GetStopReasonAsString() << "\n";
  os << indent << "NumberOfSelfIntersections: " << this->NumberOfSelfIntersections << "\n";
}
