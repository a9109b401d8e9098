#include "Image/MinimumCut.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <utility>

namespace FlipFree
{
namespace
{

// Parts of fewer nodes are not worth a thread.
constexpr std::size_t NodesOfPart = 1U << 15U;
constexpr std::size_t MaximumParts = 4;

// Asked every few milliseconds, so that an abort is prompt and asking costs nothing.
constexpr std::size_t StepsBetweenQuestions = 1U << 16U;

// Ways to the parent: one of the six neighbors, or one of these.
constexpr std::uint8_t Terminal = 6;
constexpr std::uint8_t Orphan = 7;
constexpr std::uint8_t None = 8;

enum Tree : std::uint8_t
{
  Free,
  Source,
  Sink
};

int Opposite(int way)
{
  return way ^ 1;
}

// Of some consecutive nodes, as if no others were there.
class TwoTrees
{
public:
  TwoTrees(CutNetwork& network, std::size_t begin, std::size_t end)
    : Nodes(network)
    , Begin(static_cast<int>(begin))
    , End(static_cast<int>(end))
  {
  }

  void Plant()
  {
    for (int node = this->Begin; node < this->End; ++node)
    {
      for (int way = 0; way < 6 && this->Nodes[node].Terminal < 0; ++way)
      {
        this->PullAlongLine(node, way);
      }
    }
    for (int node = this->Begin; node < this->End; ++node)
    {
      CutNode& own = this->Nodes[node];
      own.Parent = None;
      own.Tree = Free;
      own.IsActive = false;
      own.Time = 0;
      if (own.Terminal != 0)
      {
        own.Tree = own.Terminal > 0 ? Source : Sink;
        own.Parent = Terminal;
        own.Distance = 1;
        this->Activate(node);
      }
    }
  }

  // The trees of parts go on as the trees of the whole, from the nodes where the parts meet.
  void Join(const std::vector<TwoTrees>& parts)
  {
    for (const TwoTrees& part : parts)
    {
      this->Time = std::max(this->Time, part.Time + 1);
      for (int node = part.Begin; node < part.End; ++node)
      {
        const CutNode& own = this->Nodes[node];
        if (own.Tree != Free &&
          std::any_of(own.Neighbors.begin(), own.Neighbors.end(),
            [&](int to) { return this->Holds(to) && !part.Holds(to); }))
        {
          this->Activate(node);
        }
      }
    }
  }

  bool Execute(const Monitor& monitor)
  {
    int node = -1;
    for (std::size_t step = 0;; ++step)
    {
      if (step % StepsBetweenQuestions == 0 && !monitor(0))
      {
        return false;
      }
      if (node < 0 || this->Nodes[node].Tree == Free)
      {
        node = this->NextActive();
        if (node < 0)
        {
          return true;
        }
      }
      const int way = this->Grow(node);
      ++this->Time;
      if (way < 0)
      {
        node = -1;
        continue;
      }
      // The node has perhaps more to find.
      if (this->Nodes[node].Tree == Source)
      {
        this->Augment(node, way);
      }
      else
      {
        this->Augment(this->Nodes[node].Neighbors[way], Opposite(way));
      }
      this->Adopt();
    }
  }

  std::int64_t GetFlow() const { return this->Flow; }

private:
  bool Holds(int node) const { return node >= this->Begin && node < this->End; }

  void Activate(int node)
  {
    if (!this->Nodes[node].IsActive)
    {
      this->Nodes[node].IsActive = true;
      this->Active.push_back(node);
    }
  }

  int NextActive()
  {
    while (this->FirstActive < this->Active.size())
    {
      const int node = this->Active[this->FirstActive++];
      this->Nodes[node].IsActive = false;
      if (this->FirstActive > 4096 && 2 * this->FirstActive > this->Active.size())
      {
        this->Active.erase(this->Active.begin(),
          this->Active.begin() + static_cast<std::ptrdiff_t>(this->FirstActive));
        this->FirstActive = 0;
      }
      if (this->Nodes[node].Tree != Free)
      {
        return node;
      }
    }
    return -1;
  }

  // Flow from the sources on a straight line to a sink at its end. Most sinks lie along a surface,
  // with sources behind them, so that little is left to the search, which takes much longer.
  void PullAlongLine(int sink, int way)
  {
    std::int32_t missing = -this->Nodes[sink].Terminal;
    std::int32_t residual = CutNode::Infinite;
    this->FlowFrom.clear();
    int node = sink;
    while (missing > 0 && this->Holds(this->Nodes[node].Neighbors[way]))
    {
      const int next = this->Nodes[node].Neighbors[way];
      CutNode& own = this->Nodes[next];
      residual = std::min(residual, own.Capacities[Opposite(way)]);
      if (residual == 0 || own.Terminal < 0)
      {
        break;
      }
      const std::int32_t flow = std::min({ own.Terminal, residual, missing });
      own.Terminal -= flow;
      residual -= flow;
      missing -= flow;
      this->FlowFrom.push_back(flow);
      node = next;
    }
    std::int32_t flow = 0;
    for (; !this->FlowFrom.empty(); this->FlowFrom.pop_back())
    {
      flow += this->FlowFrom.back();
      CutNode& own = this->Nodes[node];
      own.Capacities[Opposite(way)] -= flow;
      node = own.Neighbors[Opposite(way)];
      this->Nodes[node].Capacities[way] += flow;
    }
    this->Nodes[sink].Terminal += flow;
    this->Flow += flow;
  }

  // The way to a node of the other tree; -1 if there is none.
  int Grow(int node)
  {
    const CutNode& own = this->Nodes[node];
    for (int way = 0; way < 6; ++way)
    {
      const int to = own.Neighbors[way];
      if (!this->Holds(to))
      {
        continue;
      }
      CutNode& neighbor = this->Nodes[to];
      if ((own.Tree == Source ? own.Capacities[way] : neighbor.Capacities[Opposite(way)]) == 0)
      {
        continue;
      }
      if (neighbor.Tree == Free)
      {
        neighbor.Tree = own.Tree;
        SetParent(neighbor, Opposite(way), own.Time, own.Distance + 1);
        this->Activate(to);
      }
      else if (neighbor.Tree != own.Tree)
      {
        return way;
      }
      else if (neighbor.Time <= own.Time && neighbor.Distance > own.Distance)
      {
        // A shorter way to the root.
        SetParent(neighbor, Opposite(way), own.Time, own.Distance + 1);
      }
    }
    return -1;
  }

  static void SetParent(CutNode& node, int way, std::int32_t time, std::int32_t distance)
  {
    node.Parent = static_cast<std::uint8_t>(way);
    node.Time = time;
    node.Distance = distance;
  }

  void MakeOrphan(int node)
  {
    this->Nodes[node].Parent = Orphan;
    this->Orphans.push_back(node);
  }

  // Calls visit(child, its way up, parent) along the path to the terminal. Returns its last node.
  template <typename Visit>
  int Climb(int node, const Visit& visit)
  {
    while (this->Nodes[node].Parent != Terminal)
    {
      const int up = this->Nodes[node].Parent;
      const int parent = this->Nodes[node].Neighbors[up];
      visit(node, up, parent);
      node = parent;
    }
    return node;
  }

  void AddToTerminal(int node, std::int32_t flow)
  {
    this->Nodes[node].Terminal += flow;
    if (this->Nodes[node].Terminal == 0)
    {
      this->MakeOrphan(node);
    }
  }

  // From child to parent; the child is an orphan if no more can flow along the tree's direction.
  void Push(int child, int up, int parent, std::int32_t flow)
  {
    std::int32_t& upwards = this->Nodes[child].Capacities[up];
    std::int32_t& downwards = this->Nodes[parent].Capacities[Opposite(up)];
    upwards -= flow;
    downwards += flow;
    if ((flow > 0 ? upwards : downwards) == 0)
    {
      this->MakeOrphan(child);
    }
  }

  // Saturates the path from the source over `node` and its neighbor to the sink.
  void Augment(int node, int way)
  {
    const int other = this->Nodes[node].Neighbors[way];
    std::int32_t flow = this->Nodes[node].Capacities[way];
    const int first = this->Climb(node,
      [&](int, int up, int parent)
      { flow = std::min(flow, this->Nodes[parent].Capacities[Opposite(up)]); });
    const int last = this->Climb(other,
      [&](int child, int up, int) { flow = std::min(flow, this->Nodes[child].Capacities[up]); });
    flow = std::min({ flow, this->Nodes[first].Terminal, -this->Nodes[last].Terminal });
    this->Flow += flow;

    this->Nodes[node].Capacities[way] -= flow;
    this->Nodes[other].Capacities[Opposite(way)] += flow;
    this->Climb(node, [&](int child, int up, int parent) { this->Push(child, up, parent, -flow); });
    this->AddToTerminal(first, -flow);
    this->Climb(other, [&](int child, int up, int parent) { this->Push(child, up, parent, flow); });
    this->AddToTerminal(last, flow);
  }

  void Adopt()
  {
    std::size_t first = 0;
    while (first < this->Orphans.size()) // which grows
    {
      this->AdoptOne(this->Orphans[first++]);
    }
    this->Orphans.clear();
  }

  // How far the node is from its terminal; the greatest number if its path ends at an orphan.
  int DistanceToTerminal(int node) const
  {
    int distance = 0;
    for (const CutNode* at = &this->Nodes[node];; at = &this->Nodes[at->Neighbors[at->Parent]])
    {
      if (at->Time == this->Time)
      {
        return distance + at->Distance;
      }
      if (at->Parent == Terminal)
      {
        return distance + 1;
      }
      if (at->Parent == Orphan)
      {
        return std::numeric_limits<int>::max();
      }
      ++distance;
    }
  }

  // Remembers along the path that it leads to the terminal.
  void Mark(int node, int distance)
  {
    for (CutNode* at = &this->Nodes[node]; at->Time != this->Time;
         at = &this->Nodes[at->Neighbors[at->Parent]])
    {
      at->Time = this->Time;
      at->Distance = distance--;
      if (at->Parent == Terminal)
      {
        return;
      }
    }
  }

  // Nothing more can flow between the node and a possible parent along the tree's direction.
  static bool IsSaturated(const CutNode& node, int way, const CutNode& parent)
  {
    return (node.Tree == Source ? parent.Capacities[Opposite(way)] : node.Capacities[way]) == 0;
  }

  void AdoptOne(int node)
  {
    CutNode& own = this->Nodes[node];
    int best = std::numeric_limits<int>::max();
    int bestWay = -1;
    for (int way = 0; way < 6; ++way)
    {
      const int neighbor = own.Neighbors[way];
      if (!this->Holds(neighbor) || this->Nodes[neighbor].Tree != own.Tree ||
        IsSaturated(own, way, this->Nodes[neighbor]))
      {
        continue;
      }
      const int distance = this->DistanceToTerminal(neighbor);
      if (distance == std::numeric_limits<int>::max())
      {
        continue;
      }
      this->Mark(neighbor, distance);
      if (distance < best)
      {
        best = distance;
        bestWay = way;
      }
    }
    if (bestWay >= 0)
    {
      SetParent(own, bestWay, this->Time, best + 1);
      return;
    }
    for (int way = 0; way < 6; ++way)
    {
      const int neighbor = own.Neighbors[way];
      if (!this->Holds(neighbor) || this->Nodes[neighbor].Tree != own.Tree)
      {
        continue;
      }
      if (!IsSaturated(own, way, this->Nodes[neighbor]))
      {
        this->Activate(neighbor);
      }
      if (this->Nodes[neighbor].Parent == Opposite(way))
      {
        this->MakeOrphan(neighbor);
      }
    }
    own.Tree = Free;
    own.Parent = None;
  }

  CutNetwork& Nodes;
  int Begin;
  int End;
  std::vector<int> Active;
  std::size_t FirstActive = 0;
  std::vector<int> Orphans;
  std::vector<std::int32_t> FlowFrom; // the nodes of a line
  int Time = 0;
  std::int64_t Flow = 0;
};

} // namespace

void MinimumCut::AddToTerminal(int node, std::int32_t capacity)
{
  std::int32_t& terminal = this->Nodes[node].Terminal;
  // What goes from the source to the sink over this node alone.
  if ((terminal < 0) != (capacity < 0))
  {
    this->Cost += std::min(std::abs(terminal), std::abs(capacity));
  }
  terminal += capacity;
}

// Most of the flow ends near where it begins. So parts are cut first, each for itself, and what is
// left to the whole is what flows between them (J. Liu, J. Sun: Parallel graph-cuts by adaptive
// bottom-up merging, 2010). The cut nearest to the source is the same, whatever the parts.
bool MinimumCut::Execute(const ParallelFor& parallelFor, const Monitor& monitor)
{
  if (!monitor(0))
  {
    return false;
  }
  const std::size_t size = this->Nodes.size();
  const std::size_t count = std::max<std::size_t>(1, std::min(MaximumParts, size / NodesOfPart));
  std::vector<TwoTrees> parts;
  for (std::size_t part = 0; part < count; ++part)
  {
    parts.emplace_back(this->Nodes, size * part / count, size * (part + 1) / count);
  }
  parallelFor(0, static_cast<std::ptrdiff_t>(count),
    [&](std::ptrdiff_t first, std::ptrdiff_t last)
    {
      for (std::ptrdiff_t part = first; part < last; ++part)
      {
        parts[part].Plant();
        parts[part].Execute(NeverStop); // the monitor belongs to one thread
      }
    });
  TwoTrees whole(this->Nodes, 0, size);
  whole.Join(parts);
  const bool done = whole.Execute(monitor);
  for (const TwoTrees& part : parts)
  {
    this->Cost += part.GetFlow();
  }
  this->Cost += whole.GetFlow();
  return done;
}

bool MinimumCut::IsOnSourceSide(int node) const
{
  return this->Nodes[node].Tree == Source;
}

} // namespace FlipFree
