// Stands before the OpenCL library (LD_PRELOAD): a driver that never answers. WAITING_FILE is made
// when it is first asked.
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

cl_int clGetPlatformIDs(cl_uint entries, cl_platform_id* platforms, cl_uint* count) {
  (void)entries;
  (void)platforms;
  (void)count;
  const char* file = getenv("WAITING_FILE");
  if (file != NULL) close(open(file, O_WRONLY | O_CREAT, 0600));
  for (;;) pause();
}
