#include "Exchange/DicomCopies.h"

#include "Exchange/DicomStack.h"

#include <map>
#include <tuple>
#include <utility>

namespace FlipFree
{
namespace
{

using FrameBytes = std::function<std::string(const DicomFrame&)>;

bool HaveSamePixels(const DicomFrame& a, const DicomFrame& b, const FrameBytes& bytesOf)
{
  const std::string bytes = bytesOf(a);
  return !bytes.empty() && bytes == bytesOf(b);
}

/// Frames that are the same if their pixels are.
class LikeFrames
{
public:
  /// Whether one of another file has this one's pixels. Else this one joins them.
  bool Holds(const DicomFrame& frame, const FrameBytes& bytesOf)
  {
    if (!this->First)
    {
      this->First = &frame; // whose pixels matter only if there is a second one
      return false;
    }
    if (this->ByDigest.empty())
    {
      this->ByDigest.emplace(DigestOf(*this->First, bytesOf), this->First);
    }
    // One of each kind of pixels is enough: those of other files are its copies.
    const auto known = this->ByDigest.emplace(DigestOf(frame, bytesOf), &frame);
    const DicomFrame& other = *known.first->second;
    return !known.second && other.File != frame.File && HaveSamePixels(other, frame, bytesOf);
  }

private:
  static std::size_t DigestOf(const DicomFrame& frame, const FrameBytes& bytesOf)
  {
    return std::hash<std::string>()(bytesOf(frame));
  }

  const DicomFrame* First = nullptr;
  std::map<std::size_t, const DicomFrame*> ByDigest;
};

} // namespace

std::set<std::size_t> RemoveDicomCopies(std::vector<DicomFrame>& frames,
  const std::function<std::string(const DicomFrame&)>& bytesOf)
{
  using Words = std::vector<std::string>;
  using Likeness = std::tuple<double, double, bool, Words>;
  std::map<Likeness, LikeFrames> atOnePlace;
  std::vector<DicomFrame> kept;
  std::set<std::size_t> files;
  const DicomFrame* place = nullptr;
  for (const DicomFrame& frame : frames)
  {
    if (!place || !AreAtOnePlace(*place, frame))
    {
      place = &frame;
      atOnePlace.clear();
    }
    const auto isIn = [&](bool byInstance, const Words& words)
    {
      return atOnePlace[Likeness(frame.Rescale.Slope, frame.Rescale.Intercept, byInstance, words)]
        .Holds(frame, bytesOf);
    };
    const bool isOfInstance = isIn(true, { frame.Instance, std::to_string(frame.Number) });
    if (isIn(false, frame.Keys) || isOfInstance)
    {
      files.insert(frame.File);
    }
    else
    {
      kept.push_back(frame);
    }
  }
  frames = std::move(kept);
  return files;
}

} // namespace FlipFree
