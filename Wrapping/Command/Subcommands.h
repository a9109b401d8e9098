/**
 * What the subcommands do.
 */
#ifndef FlipFreeCommandSubcommands_h
#define FlipFreeCommandSubcommands_h

namespace Command
{

struct EvaluateRequest;
struct PhantomRequest;
struct SegmentRequest;
struct SeriesRequest;
struct SurfacesRequest;
struct TraceRequest;

void Segment(const SegmentRequest& request);
void Trace(const TraceRequest& given);
void MakeSurfaces(const SurfacesRequest& request);
void Evaluate(const EvaluateRequest& evaluation);
void ListSeries(const SeriesRequest& list);
void MakePhantom(const PhantomRequest& phantom);

} // namespace Command

#endif
