// Stands before the C library (LD_PRELOAD) and stops time in the middle of a write, for as long as
// a test needs: the PAUSE_AT-th write to a file whose name ends in PAUSE_IN writes half of its
// bytes, makes the file PAUSE_FILE, and waits until that is gone. WRITES_FILE gets the number of
// such writes in the end.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static atomic_long writes;

static int is_in_question(int file) {
  const char* ending = getenv("PAUSE_IN");
  char link[64], name[4096];
  if (ending == NULL) return 0;
  snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  const ssize_t length = readlink(link, name, sizeof name);
  const ssize_t tail = (ssize_t)strlen(ending);
  return length >= tail && memcmp(name + length - tail, ending, (size_t)tail) == 0;
}

// Whether this is the write to pause in.
static int is_the_one(int file) {
  const char* at = getenv("PAUSE_AT");
  if (!is_in_question(file)) return 0;
  const long number = atomic_fetch_add(&writes, 1) + 1;
  return at != NULL && number == atol(at);
}

static void pause_here(void) {
  const char* mark = getenv("PAUSE_FILE");
  if (mark == NULL) return;
  close(open(mark, O_WRONLY | O_CREAT, 0600));
  while (access(mark, F_OK) == 0) usleep(1000);
}

ssize_t write(int file, const void* bytes, size_t size) {
  ssize_t (*next)(int, const void*, size_t) = dlsym(RTLD_NEXT, "write");
  if (!is_the_one(file)) return next(file, bytes, size);
  const ssize_t half = next(file, bytes, size / 2);
  pause_here();
  if (half < 0) return half;
  const ssize_t rest = next(file, (const char*)bytes + half, size - (size_t)half);
  return rest < 0 ? half : half + rest;
}

ssize_t pwrite64(int file, const void* bytes, size_t size, off64_t at) {
  ssize_t (*next)(int, const void*, size_t, off64_t) = dlsym(RTLD_NEXT, "pwrite64");
  if (!is_the_one(file)) return next(file, bytes, size, at);
  const ssize_t half = next(file, bytes, size / 2, at);
  pause_here();
  if (half < 0) return half;
  const ssize_t rest = next(file, (const char*)bytes + half, size - (size_t)half, at + half);
  return rest < 0 ? half : half + rest;
}

ssize_t pwrite(int file, const void* bytes, size_t size, off_t at) {
  return pwrite64(file, bytes, size, at);
}

// Programs that this one starts write no such files.
__attribute__((destructor)) static void tell(void) {
  const char* path = getenv("WRITES_FILE");
  const long number = atomic_load(&writes);
  FILE* out = path == NULL || number == 0 ? NULL : fopen(path, "w");
  if (out == NULL) return;
  fprintf(out, "%ld\n", number);
  fclose(out);
}
