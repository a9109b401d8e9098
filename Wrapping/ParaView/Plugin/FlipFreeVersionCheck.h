/**
 * Called when ParaView loads the plugin.
 */
#ifndef FlipFreeVersionCheck_h
#define FlipFreeVersionCheck_h

namespace FlipFree
{

/// Warns, naming both and the remedy, where the ParaView that loads the plugin is another version
/// than the one it was built with. ParaView itself checks nothing: libraries of another minor
/// version are not found by the system's loader, those of another patch version are taken silently.
void CheckParaViewVersion();

} // namespace FlipFree

#endif
