/**
 * Which blocks are nodes of a network, and their numbers, in a bit and a half per block.
 */
#ifndef FlipFreeBlockNodes_h
#define FlipFreeBlockNodes_h

#include "Image/MinimumCut.h"

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace FlipFree
{

class BlockNodes
{
public:
  BlockNodes() = default;

  /// The nodes are the blocks for which `isNode` holds, asked in order.
  template <typename IsNode>
  BlockNodes(std::size_t blocks, const IsNode& isNode)
    : Blocks(blocks)
    , Words((blocks + BitsOfWord - 1) / BitsOfWord, 0)
    , Before(Words.size(), 0)
  {
    for (std::size_t block = 0; block < blocks; ++block)
    {
      const std::size_t word = block / BitsOfWord;
      if (block % BitsOfWord == 0)
      {
        this->Before[word] = this->Nodes;
      }
      if (isNode(block))
      {
        this->Words[word] |= BitOf(block);
        ++this->Nodes;
      }
    }
  }

  std::size_t NumberOfBlocks() const { return this->Blocks; }
  int NumberOfNodes() const { return this->Nodes; }

  bool IsNode(std::size_t block) const
  {
    return (this->Words[block / BitsOfWord] & BitOf(block)) != 0;
  }

  /// The block's number among the nodes; CutNode::NoNeighbor if it is none.
  int operator[](std::size_t block) const
  {
    if (!this->IsNode(block))
    {
      return CutNode::NoNeighbor;
    }
    const std::size_t word = block / BitsOfWord;
    const std::bitset<BitsOfWord> before(this->Words[word] & (BitOf(block) - 1));
    return this->Before[word] + static_cast<int>(before.count());
  }

private:
  using Word = std::uint64_t;
  static constexpr std::size_t BitsOfWord = 64;

  static Word BitOf(std::size_t block) { return Word(1) << (block % BitsOfWord); }

  std::size_t Blocks = 0;
  int Nodes = 0;
  std::vector<Word> Words;
  std::vector<int> Before; // the nodes before each word
};

} // namespace FlipFree

#endif
