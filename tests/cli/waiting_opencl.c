// Stands before the OpenCL library (LD_PRELOAD): a driver that never answers or, with
// WAITING_IN_BUILD set, a compiler that never ends. WAITING_FILE is made when it is first asked.
#define _GNU_SOURCE
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

static void wait_for_ever(void) {
  const char* file = getenv("WAITING_FILE");
  if (file != NULL) close(open(file, O_WRONLY | O_CREAT, 0600));
  for (;;) pause();
}

cl_int clGetPlatformIDs(cl_uint entries, cl_platform_id* platforms, cl_uint* count) {
  cl_int (*next)(cl_uint, cl_platform_id*, cl_uint*) = dlsym(RTLD_NEXT, "clGetPlatformIDs");
  if (getenv("WAITING_IN_BUILD") == NULL) wait_for_ever();
  return next(entries, platforms, count);
}

cl_int clBuildProgram(cl_program program, cl_uint count, const cl_device_id* devices,
                      const char* options, void(CL_CALLBACK* notify)(cl_program, void*),
                      void* data) {
  cl_int (*next)(cl_program, cl_uint, const cl_device_id*, const char*,
                 void(CL_CALLBACK*)(cl_program, void*), void*) =
      dlsym(RTLD_NEXT, "clBuildProgram");
  if (getenv("WAITING_IN_BUILD") != NULL) wait_for_ever();
  return next(program, count, devices, options, notify, data);
}
