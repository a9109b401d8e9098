/**
 * A column of a table whose rows are records, for all front ends.
 */
#ifndef FlipFreeTableColumn_h
#define FlipFreeTableColumn_h

namespace FlipFree
{

template <typename Record>
struct TableColumn
{
  const char* Name;
  bool IsCount; ///< whole numbers
  double (*Read)(const Record&);
};

} // namespace FlipFree

#endif
