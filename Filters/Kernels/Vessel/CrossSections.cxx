#include "Vessel/CrossSections.h"

#include "Intensity/RobustStatistics.h"
#include "Quantile.h"
#include "Vessel/Polyline.h"
#include "Vessel/SectionRays.h"
#include "Vessel/SectionSupport.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace FlipFree
{
namespace
{

// Radii on a ray are multiples of the ray step: labels 0, 1, ...
constexpr int LargestStep = 2;       // between neighboring rays, in labels
constexpr double FullSupport = 0.8;  // from which on a section has a radius of its own
constexpr double NoSupport = 0.4;    // by chance
constexpr double LeastLent = 1e-6;   // so that there is always a radius to be lent
constexpr double Swollen = 1.1;      // of the radius nearby
constexpr double SwollenWeight = 6;  // of the prior, more than elsewhere
constexpr double SupportLength = 15; // along the vessel, of sections that lend others theirs; mm

class SectionFit
{
public:
  SectionFit(const ImageView<float>& image, const PointList& line, const Eigen::VectorXd& radii,
    const CrossSectionSettings& settings, const ParallelFor& parallelFor)
    : Image(image)
    , Settings(settings)
    , Parallel(parallelFor)
    , Line(line)
    , Radii(radii.replicate(1, settings.Rays))
  {
  }

  VesselSections Fit()
  {
    for (int round = 0; round < this->Settings.Rounds; ++round)
    {
      if (round > 0)
      {
        this->Recenter();
      }
      this->Frames = MakeSectionFrames(this->Line);
      this->Rays.emplace(this->Image, this->Frames, this->Settings.Rays);
      this->FitOnce(round);
    }
    this->Refine();
    this->DropThorns();
    return { this->Frames, this->Radii };
  }

private:
  std::ptrdiff_t Sections() const { return this->Line.rows(); }

  double Sample(std::ptrdiff_t section, int ray, int label) const
  {
    return this->Rays->Sample(section, ray, label * this->Settings.RayStep);
  }

  // Moves the line to the sections' centroids, keeps it smooth, and carries the radii over.
  void Recenter()
  {
    const VesselSections now{ this->Frames, this->Radii };
    const Eigen::VectorXd mean = now.MeanRadii();
    const PointList moved = SmoothLine(now.Centers(), this->Settings.LineDeviation);
    const Eigen::VectorXd before = ArcLengths(moved);
    this->Line = ResampleLine(moved, this->Settings.SectionStep);
    const Eigen::VectorXd after = ArcLengths(this->Line);
    this->Radii.resize(this->Line.rows(), this->Settings.Rays);
    Eigen::Index from = 0;
    for (Eigen::Index section = 0; section < this->Line.rows(); ++section)
    {
      while (from + 1 < before.size() && before[from + 1] <= after[section])
      {
        ++from;
      }
      this->Radii.row(section).setConstant(mean[from]);
    }
  }

  // The gray value of the vessel at each section, and its deviation along the vessel.
  void ModelIntensities(const Eigen::VectorXd& mean)
  {
    Eigen::VectorXd medians(this->Sections());
    std::vector<double> deviations;
    for (std::ptrdiff_t section = 0; section < this->Sections(); ++section)
    {
      const double reach = std::min(5.0, std::max(1.5, 0.6 * mean[section]));
      std::vector<float> values;
      for (int label = 0; label * this->Settings.RayStep <= reach; ++label)
      {
        // As many rays as the circle has room for.
        const int every = std::max(1, this->Settings.Rays / std::max(1, 6 * label));
        for (int ray = 0; ray < (label == 0 ? 1 : this->Settings.Rays); ray += every)
        {
          values.push_back(static_cast<float>(this->Sample(section, ray, label)));
        }
      }
      const RobustStatistics statistics = RobustStatisticsOf(values);
      medians[section] = statistics.Median;
      deviations.push_back(statistics.StandardDeviation);
    }
    this->Medians = MedianAlong(medians, this->Settings.IntensityWindow);
    this->Deviation = std::min(this->Settings.MaximumDeviation,
      std::max(this->Settings.MinimumDeviation, TakeMedian(deviations)));
  }

  void FitOnce(int round)
  {
    const VesselSections now{ this->Frames, this->Radii };
    const Eigen::VectorXd mean = now.MeanRadii();
    this->ModelIntensities(mean);
    this->Prior =
      (1 - this->Settings.PriorFollow) * MedianAlong(mean, 7) + this->Settings.PriorFollow * mean;
    this->PriorWeights = Eigen::VectorXd::Constant(this->Sections(), this->Settings.PriorWeight);
    if (round > 0)
    {
      this->LendRadii(SectionSupport(this->Image, now, this->Parallel), mean);
    }
    this->Labels =
      1 + static_cast<int>(std::ceil((2 * this->Prior.maxCoeff() + 1.5) / this->Settings.RayStep));
    this->Costs.assign(this->Sections() * this->Settings.Rays * this->Labels, 0);
    this->Limits.resize(this->Sections() * this->Settings.Rays);
    this->Parallel(0, this->Sections(),
      [this](std::ptrdiff_t first, std::ptrdiff_t last)
      {
        for (std::ptrdiff_t section = first; section < last; ++section)
        {
          this->MakeCosts(section);
        }
      });
    this->Decide();
  }

  // An outline that the image does not show runs away. There, the prior is the mean radius nearby,
  // by how well the image shows it; where the outline has swollen beyond that, the prior counts
  // for more.
  void LendRadii(const Eigen::VectorXd& support, const Eigen::VectorXd& mean)
  {
    const double length = SupportLength / this->Settings.SectionStep;
    for (Eigen::Index section = 0; section < support.size(); ++section)
    {
      double weights = this->Settings.LentRadius > 0 ? 1 : LeastLent;
      double sum = weights *
        (this->Settings.LentRadius > 0 ? this->Settings.LentRadius : this->Prior[section]);
      for (Eigen::Index other = 0; other < support.size(); ++other)
      {
        const double distance = std::abs(static_cast<double>(other - section)) / length;
        const double weight = PartShown(support[other]) * std::exp(-distance);
        weights += weight;
        sum += weight * mean[other];
      }
      const double lent = sum / weights;
      const double shown = PartShown(support[section]);
      if (mean[section] > Swollen * lent)
      {
        this->Prior[section] = shown * this->Prior[section] + (1 - shown) * lent;
        this->PriorWeights[section] *= 1 + SwollenWeight * (1 - shown);
      }
      else
      {
        const double own = std::min(1.0, support[section] / FullSupport);
        this->Prior[section] = own * own * this->Prior[section] + (1 - own * own) * lent;
      }
    }
  }

  // How much of a section's outline the image shows, for what others learn from it.
  static double PartShown(double support)
  {
    const double part =
      std::max(0.0, std::min(1.0, (support - NoSupport) / (FullSupport - NoSupport)));
    return part * part;
  }

  float* CostsOf(std::ptrdiff_t section, int ray)
  {
    return this->Costs.data() + (section * this->Settings.Rays + ray) * this->Labels;
  }

  void MakeCosts(std::ptrdiff_t section)
  {
    const double step = this->Settings.RayStep;
    const int beyond = static_cast<int>(std::ceil(4.0 / step));
    const int half = std::max(1, static_cast<int>(std::lround(0.5 / step)));
    std::vector<double> d(this->Labels + beyond + half + 1);
    const double farthest = 2 * this->Prior[section] + 1.5;
    for (int ray = 0; ray < this->Settings.Rays; ++ray)
    {
      for (int label = 0; label < static_cast<int>(d.size()); ++label)
      {
        d[label] = this->Sample(section, ray, label) - this->Medians[section];
      }
      const int rim =
        std::min(this->Labels - 1, static_cast<int>(std::lround(this->Radii(section, ray) / step)));
      const auto [least, most] = std::minmax_element(d.begin() + rim, d.begin() + rim + beyond + 1);
      const double floor = 2.5 * this->Deviation;
      // The outline is at half of the contrast, of a high one at a third.
      const double limit = std::max(this->Settings.DarkLimit, -*least / 3);
      const double dark = std::max(floor, std::min(limit, -*least / 2));
      const double bright = std::max(floor, std::min(this->Settings.BrightLimit, *most / 2));
      this->Limits[section * this->Settings.Rays + ray] = { dark, bright };
      float* const costs = this->CostsOf(section, ray);
      double sum = 0;
      for (int label = 0; label < this->Labels; ++label)
      {
        const double z = d[label] / (d[label] < 0 ? dark : bright);
        sum -= 0.5 * std::max(-1.0, 1 - z * z) * step * 2;
        const double rise =
          (std::abs(d[label + half]) - std::abs(d[std::max(0, label - half)])) / 15;
        const double prior = (label - this->Prior[section] / step);
        costs[label] = static_cast<float>(label * step > farthest || label < 2
            ? 1e6
            : sum - this->Settings.EdgeWeight * std::max(0.0, std::min(2.0, rise)) +
              this->PriorWeights[section] * prior * prior);
      }
    }
  }

  // Alternating sweeps over the sections; each is decided given its neighbors.
  void Decide()
  {
    const int rays = this->Settings.Rays;
    this->Choice.assign(this->Sections() * rays, 0);
    for (std::ptrdiff_t section = 0; section < this->Sections(); ++section)
    {
      for (int ray = 0; ray < rays; ++ray)
      {
        this->Choice[section * rays + ray] =
          static_cast<int>(std::lround(this->Prior[section] / this->Settings.RayStep));
      }
    }
    for (int sweep = 0; sweep < 4; ++sweep)
    {
      for (std::ptrdiff_t place = 0; place < this->Sections(); ++place)
      {
        this->DecideSection(sweep % 2 == 0 ? place : this->Sections() - 1 - place);
      }
    }
    this->Radii.resize(this->Sections(), rays);
    for (std::ptrdiff_t section = 0; section < this->Sections(); ++section)
    {
      for (int ray = 0; ray < rays; ++ray)
      {
        this->Radii(section, ray) = this->Settings.RayStep * this->Choice[section * rays + ray];
      }
    }
  }

  // Two rounds over the circle of rays; the middle of them does not see where they begin.
  void DecideSection(std::ptrdiff_t section)
  {
    const int rays = this->Settings.Rays;
    const int labels = this->Labels;
    std::vector<float> total(labels);
    std::vector<float> now(labels);
    // Beyond all labels, none can come from there.
    constexpr float never = std::numeric_limits<float>::infinity();
    std::vector<float> padded(labels + 2 * LargestStep, never);
    float* const before = padded.data() + LargestStep;
    std::vector<int> from(2 * rays * labels);
    for (int turn = 0; turn < 2 * rays; ++turn)
    {
      this->AddNeighbors(section, turn % rays, total);
      int* const source = from.data() + turn * labels;
      std::fill(now.begin(), now.end(), turn > 0 ? never : 0);
      for (int step = -LargestStep; turn > 0 && step <= LargestStep; ++step)
      {
        const auto bend = static_cast<float>(this->Settings.AroundWeight * step * step);
        for (int label = 0; label < labels; ++label)
        {
          const float cost = before[label + step] + bend;
          source[label] = cost < now[label] ? label + step : source[label];
          now[label] = std::min(cost, now[label]);
        }
      }
      for (int label = 0; label < labels; ++label)
      {
        before[label] = total[label] + now[label];
      }
    }
    int label = static_cast<int>(std::min_element(before, before + labels) - before);
    for (int turn = 2 * rays - 1; turn >= 0; --turn)
    {
      if (turn >= rays / 2 && turn < rays / 2 + rays)
      {
        this->Choice[section * rays + turn % rays] = label;
      }
      label = from[turn * labels + label];
    }
  }

  // From the last label inside to where the gray value leaves the vessel's, between samples.
  void Refine()
  {
    for (std::ptrdiff_t section = 0; section < this->Sections(); ++section)
    {
      for (int ray = 0; ray < this->Settings.Rays; ++ray)
      {
        const int label = this->Choice[section * this->Settings.Rays + ray];
        double before = this->Excess(section, ray, std::max(0, label - 1));
        for (int outer = std::max(1, label); outer <= label + 2; ++outer)
        {
          const double now = this->Excess(section, ray, outer);
          if (before < 0 && now >= 0)
          {
            this->Radii(section, ray) = this->Settings.RayStep * (outer - now / (now - before));
            break;
          }
          before = now;
        }
      }
    }
  }

  // Single rays that stick out or in: the median of each and those around and along it.
  void DropThorns()
  {
    const Eigen::MatrixXd before = this->Radii;
    const Eigen::Index rays = before.cols();
    for (Eigen::Index section = 0; section < before.rows(); ++section)
    {
      const Eigen::Index first = std::max<Eigen::Index>(0, section - 1);
      const Eigen::Index last = std::min<Eigen::Index>(before.rows() - 1, section + 1);
      for (Eigen::Index ray = 0; ray < rays; ++ray)
      {
        std::vector<double> near;
        for (Eigen::Index other = first; other <= last; ++other)
        {
          for (const Eigen::Index side : { ray, (ray + 1) % rays, (ray + rays - 1) % rays })
          {
            near.push_back(before(other, side));
          }
        }
        this->Radii(section, ray) = TakeMedian(near);
      }
    }
  }

  // Beyond the limits of the vessel's gray values: positive outside.
  double Excess(std::ptrdiff_t section, int ray, int label) const
  {
    const double d = this->Sample(section, ray, label) - this->Medians[section];
    const auto& [dark, bright] = this->Limits[section * this->Settings.Rays + ray];
    return std::abs(d) / (d < 0 ? dark : bright) - 1;
  }

  void AddNeighbors(std::ptrdiff_t section, int ray, std::vector<float>& total)
  {
    const float* const costs = this->CostsOf(section, ray);
    const int rays = this->Settings.Rays;
    std::copy_n(costs, this->Labels, total.begin());
    const auto weight = static_cast<float>(this->Settings.AlongWeight);
    for (const std::ptrdiff_t other : { section - 1, section + 1 })
    {
      if (other < 0 || other >= this->Sections())
      {
        continue;
      }
      const auto choice = static_cast<float>(this->Choice[other * rays + ray]);
      for (int label = 0; label < this->Labels; ++label)
      {
        const float step = static_cast<float>(label) - choice;
        total[label] += weight * std::min(step * step, 100.0F);
      }
    }
  }

  const ImageView<float>& Image;
  const CrossSectionSettings& Settings;
  const ParallelFor& Parallel;
  PointList Line;
  std::vector<SectionFrame> Frames;
  std::optional<SectionRays> Rays;
  Eigen::MatrixXd Radii;
  Eigen::VectorXd Medians;
  double Deviation = 0;
  Eigen::VectorXd Prior;
  Eigen::VectorXd PriorWeights;
  int Labels = 0;
  std::vector<float> Costs;
  std::vector<std::pair<double, double>> Limits; // dark and bright, per section and ray
  std::vector<int> Choice;
};

} // namespace

PointList VesselSections::Centers() const
{
  const auto rays = static_cast<int>(this->Radii.cols());
  PointList centers(static_cast<Eigen::Index>(this->Frames.size()), 3);
  for (Eigen::Index section = 0; section < centers.rows(); ++section)
  {
    const SectionFrame& frame = this->Frames[section];
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double area = 0;
    for (int ray = 0; ray < rays; ++ray)
    {
      // A sector's centroid is at two thirds of its radius.
      const double radius = this->Radii(section, ray);
      sum += radius * radius * 2 / 3 * radius * frame.Ray(2 * EIGEN_PI * ray / rays);
      area += radius * radius;
    }
    centers.row(section) = area > 0 ? Eigen::Vector3d(frame.Origin + sum / area) : frame.Origin;
  }
  return centers;
}

Eigen::VectorXd VesselSections::MeanRadii() const
{
  return this->Radii.rowwise().squaredNorm().cwiseSqrt() /
    std::sqrt(static_cast<double>(this->Radii.cols()));
}

VesselSections FitSections(const ImageView<float>& image, const PointList& line,
  const Eigen::VectorXd& radii, const CrossSectionSettings& settings,
  const ParallelFor& parallelFor)
{
  return SectionFit(image, line, radii, settings, parallelFor).Fit();
}

} // namespace FlipFree
