/* What GCC's headers and libstdc++ take of a newer C library than the one that is linked
 * (make-compiler.sh), in terms of what the older one has. It is linked into the wheel and seen
 * nowhere else. */
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#define HIDDEN __attribute__((visibility("hidden")))

/* Since 2.32. As if there always were several threads. */
HIDDEN char __libc_single_threaded = 0;

/* Since 2.33; before, they were inline functions over these. */
int __xstat(int, const char*, struct stat*);
int __lxstat(int, const char*, struct stat*);
int __fxstat(int, int, struct stat*);
int __fxstatat(int, int, const char*, struct stat*, int);

#ifdef __x86_64__
enum
{
  Version = 1
};
#else
enum
{
  Version = 0
};
#endif

HIDDEN int stat(const char* path, struct stat* status)
{
  return __xstat(Version, path, status);
}

HIDDEN int lstat(const char* path, struct stat* status)
{
  return __lxstat(Version, path, status);
}

HIDDEN int fstat(int file, struct stat* status)
{
  return __fxstat(Version, file, status);
}

HIDDEN int fstatat(int folder, const char* path, struct stat* status, int flags)
{
  return __fxstatat(Version, folder, path, status, flags);
}

/* libstdc++ opens files of any size by this name; on processors of 64 bits, both are the same. */
HIDDEN int fstat64(int file, struct stat64* status)
{
  return __fxstat(Version, file, (struct stat*)status);
}

/* Since 2.36; std::random_device, which we do not use, comes with parts of libstdc++ that we do. */
HIDDEN unsigned int arc4random(void)
{
  unsigned int number = 0;
  while (getentropy(&number, sizeof number) != 0)
  {
  }
  return number;
}
