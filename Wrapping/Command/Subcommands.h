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
void Trace(const TraceRequest& request);
void MakeSurfaces(const SurfacesRequest& request);
void Evaluate(const EvaluateRequest& evaluation);
void ListSeries(const SeriesRequest& request);
void MakePhantom(const PhantomRequest& request);

} // namespace Command

#endif
