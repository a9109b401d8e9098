#include "Image/MinimumCut.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace FlipFree
{
namespace
{

// Some milliseconds.
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

class TwoTrees
{
public:
  explicit TwoTrees(CutNetwork& network)
    : Net(network)
    , Trees(network.Size(), Free)
    , Parents(network.Size(), None)
    , IsActive(network.Size(), 0)
    , Times(network.Size(), 0)
    , Distances(network.Size(), 0)
  {
    for (int node = 0; node < static_cast<int>(network.Size()); ++node)
    {
      const std::int32_t terminal = network.Terminals[node];
      if (terminal != 0)
      {
        this->Trees[node] = terminal > 0 ? Source : Sink;
        this->Parents[node] = Terminal;
        this->Distances[node] = 1;
        this->Activate(node);
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
      if (node < 0 || this->Trees[node] == Free)
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
      if (this->Trees[node] == Source)
      {
        this->Augment(node, way);
      }
      else
      {
        this->Augment(this->Net.Neighbors[node][way], Opposite(way));
      }
      this->Adopt();
    }
  }

  std::vector<unsigned char> TakeSourceSide()
  {
    for (std::uint8_t& tree : this->Trees)
    {
      tree = tree == Source ? 1 : 0;
    }
    return std::move(this->Trees);
  }

private:
  void Activate(int node)
  {
    if (!this->IsActive[node])
    {
      this->IsActive[node] = 1;
      this->Active.push_back(node);
    }
  }

  int NextActive()
  {
    while (this->FirstActive < this->Active.size())
    {
      const int node = this->Active[this->FirstActive++];
      this->IsActive[node] = 0;
      if (this->FirstActive > 4096 && 2 * this->FirstActive > this->Active.size())
      {
        this->Active.erase(this->Active.begin(),
          this->Active.begin() + static_cast<std::ptrdiff_t>(this->FirstActive));
        this->FirstActive = 0;
      }
      if (this->Trees[node] != Free)
      {
        return node;
      }
    }
    return -1;
  }

  // What can still flow along the tree's direction from the node to its neighbor.
  std::int32_t Residual(int node, int way, int neighbor) const
  {
    return this->Trees[node] == Source ? this->Net.Capacities[node][way]
                                       : this->Net.Capacities[neighbor][Opposite(way)];
  }

  // The way to a node of the other tree; -1 if there is none.
  int Grow(int node)
  {
    for (int way = 0; way < 6; ++way)
    {
      const int neighbor = this->Net.Neighbors[node][way];
      if (neighbor < 0 || this->Residual(node, way, neighbor) == 0)
      {
        continue;
      }
      if (this->Trees[neighbor] == Free)
      {
        this->Trees[neighbor] = this->Trees[node];
        this->Parents[neighbor] = static_cast<std::uint8_t>(Opposite(way));
        this->Times[neighbor] = this->Times[node];
        this->Distances[neighbor] = this->Distances[node] + 1;
        this->Activate(neighbor);
      }
      else if (this->Trees[neighbor] != this->Trees[node])
      {
        return way;
      }
      else if (this->Times[neighbor] <= this->Times[node] &&
        this->Distances[neighbor] > this->Distances[node])
      {
        // A shorter way to the root.
        this->Parents[neighbor] = static_cast<std::uint8_t>(Opposite(way));
        this->Times[neighbor] = this->Times[node];
        this->Distances[neighbor] = this->Distances[node] + 1;
      }
    }
    return -1;
  }

  void MakeOrphan(int node)
  {
    this->Parents[node] = Orphan;
    this->Orphans.push_back(node);
  }

  // Saturates the path from the source over `node` and its neighbor to the sink.
  void Augment(int node, int way)
  {
    const int other = this->Net.Neighbors[node][way];
    std::int32_t flow = this->Net.Capacities[node][way];
    int at = node;
    for (; this->Parents[at] != Terminal; at = this->Net.Neighbors[at][this->Parents[at]])
    {
      const int up = this->Parents[at];
      flow = std::min(flow, this->Net.Capacities[this->Net.Neighbors[at][up]][Opposite(up)]);
    }
    flow = std::min(flow, this->Net.Terminals[at]);
    for (at = other; this->Parents[at] != Terminal; at = this->Net.Neighbors[at][this->Parents[at]])
    {
      flow = std::min(flow, this->Net.Capacities[at][this->Parents[at]]);
    }
    flow = std::min(flow, -this->Net.Terminals[at]);

    this->Net.Capacities[node][way] -= flow;
    this->Net.Capacities[other][Opposite(way)] += flow;
    at = node;
    while (this->Parents[at] != Terminal)
    {
      const int up = this->Parents[at];
      const int parent = this->Net.Neighbors[at][up];
      this->Net.Capacities[at][up] += flow;
      this->Net.Capacities[parent][Opposite(up)] -= flow;
      if (this->Net.Capacities[parent][Opposite(up)] == 0)
      {
        this->MakeOrphan(at);
      }
      at = parent;
    }
    this->Net.Terminals[at] -= flow;
    if (this->Net.Terminals[at] == 0)
    {
      this->MakeOrphan(at);
    }
    at = other;
    while (this->Parents[at] != Terminal)
    {
      const int up = this->Parents[at];
      const int parent = this->Net.Neighbors[at][up];
      this->Net.Capacities[at][up] -= flow;
      this->Net.Capacities[parent][Opposite(up)] += flow;
      if (this->Net.Capacities[at][up] == 0)
      {
        this->MakeOrphan(at);
      }
      at = parent;
    }
    this->Net.Terminals[at] += flow;
    if (this->Net.Terminals[at] == 0)
    {
      this->MakeOrphan(at);
    }
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
    for (int at = node;;)
    {
      if (this->Times[at] == this->Time)
      {
        return distance + this->Distances[at];
      }
      const int up = this->Parents[at];
      if (up == Terminal)
      {
        return distance + 1;
      }
      if (up == Orphan)
      {
        return std::numeric_limits<int>::max();
      }
      ++distance;
      at = this->Net.Neighbors[at][up];
    }
  }

  // Remembers along the path that it leads to the terminal.
  void Mark(int node, int distance)
  {
    for (int at = node; this->Times[at] != this->Time;
         at = this->Net.Neighbors[at][this->Parents[at]])
    {
      this->Times[at] = this->Time;
      this->Distances[at] = distance--;
      if (this->Parents[at] == Terminal)
      {
        return;
      }
    }
  }

  void AdoptOne(int node)
  {
    int best = std::numeric_limits<int>::max();
    int bestWay = -1;
    for (int way = 0; way < 6; ++way)
    {
      const int neighbor = this->Net.Neighbors[node][way];
      if (neighbor < 0 || this->Trees[neighbor] != this->Trees[node] ||
        this->ResidualFrom(neighbor, node, way) == 0)
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
      this->Parents[node] = static_cast<std::uint8_t>(bestWay);
      this->Times[node] = this->Time;
      this->Distances[node] = best + 1;
      return;
    }
    for (int way = 0; way < 6; ++way)
    {
      const int neighbor = this->Net.Neighbors[node][way];
      if (neighbor < 0 || this->Trees[neighbor] != this->Trees[node])
      {
        continue;
      }
      if (this->ResidualFrom(neighbor, node, way) > 0)
      {
        this->Activate(neighbor);
      }
      if (this->Parents[neighbor] == Opposite(way))
      {
        this->MakeOrphan(neighbor);
      }
    }
    this->Trees[node] = Free;
    this->Parents[node] = None;
  }

  // From a possible parent to the node, whose neighbor it is on the way given.
  std::int32_t ResidualFrom(int parent, int node, int way) const
  {
    return this->Trees[node] == Source ? this->Net.Capacities[parent][Opposite(way)]
                                       : this->Net.Capacities[node][way];
  }

  CutNetwork& Net;
  std::vector<std::uint8_t> Trees;
  std::vector<std::uint8_t> Parents;
  std::vector<std::uint8_t> IsActive;
  std::vector<std::int32_t> Times;     // when the distance was known to be right
  std::vector<std::int32_t> Distances; // to the terminal, in nodes
  std::vector<int> Active;
  std::size_t FirstActive = 0;
  std::vector<int> Orphans;
  int Time = 0;
};

} // namespace

std::vector<unsigned char> SourceSide(CutNetwork& network, const Monitor& monitor)
{
  TwoTrees trees(network);
  return trees.Execute(monitor) ? trees.TakeSourceSide() : std::vector<unsigned char>();
}

} // namespace FlipFree
