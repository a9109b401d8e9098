/**
 * Eigen includes this header of MMX wherever there is SSE, and uses nothing of it. Emscripten has
 * SSE, by its own vectors, and no MMX; clang's header does not compile there.
 */
