// Stands before the OpenCL library (LD_PRELOAD) and lets one device fail: the one that is used
// first, with all its queues. FAILING_CALL names the call, FAILING_AFTER how often it still works
// there; FAILED_FILE is made when it fails. Launches of a process with AWAITED_FILE wait until there is such a file.
#define _GNU_SOURCE
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// Whether this call is to fail in this context, which is one device's.
static int fails(const char* call, cl_context context) {
  static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
  static cl_context failing = NULL;
  static long calls = 0;
  const char* chosen = getenv("FAILING_CALL");
  const char* after = getenv("FAILING_AFTER");
  if (chosen == NULL || after == NULL || strcmp(chosen, call) != 0) return 0;
  pthread_mutex_lock(&mutex);
  if (failing == NULL) failing = context;
  const int result = failing == context && calls++ >= atol(after);
  pthread_mutex_unlock(&mutex);
  const char* file = getenv("FAILED_FILE");
  if (result && file != NULL) close(open(file, O_WRONLY | O_CREAT, 0600));
  return result;
}

static void wait_for_file(void) {
  const char* file = getenv("AWAITED_FILE");
  while (file != NULL && access(file, F_OK) != 0) usleep(1000);
}

cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions,
                              const size_t* offset, const size_t* global, const size_t* local,
                              cl_uint waits, const cl_event* wait_list, cl_event* event) {
  cl_int (*next)(cl_command_queue, cl_kernel, cl_uint, const size_t*, const size_t*, const size_t*,
                 cl_uint, const cl_event*, cl_event*) = dlsym(RTLD_NEXT, "clEnqueueNDRangeKernel");
  wait_for_file();
  // How many queues a device has, and so how many launches a queue, follows from its lanes.
  cl_context context = NULL;
  clGetCommandQueueInfo(queue, CL_QUEUE_CONTEXT, sizeof context, &context, NULL);
  if (fails("launch", context)) return CL_OUT_OF_RESOURCES;
  return next(queue, kernel, dimensions, offset, global, local, waits, wait_list, event);
}

cl_mem clCreateBuffer(cl_context context, cl_mem_flags flags, size_t size, void* host,
                      cl_int* error) {
  cl_mem (*next)(cl_context, cl_mem_flags, size_t, void*, cl_int*) =
      dlsym(RTLD_NEXT, "clCreateBuffer");
  if (fails("allocate", context)) {
    if (error != NULL) *error = CL_MEM_OBJECT_ALLOCATION_FAILURE;
    return NULL;
  }
  return next(context, flags, size, host, error);
}

cl_int clBuildProgram(cl_program program, cl_uint devices, const cl_device_id* device_list,
                      const char* options, void(CL_CALLBACK* notify)(cl_program, void*),
                      void* data) {
  cl_int (*next)(cl_program, cl_uint, const cl_device_id*, const char*,
                 void(CL_CALLBACK*)(cl_program, void*), void*) = dlsym(RTLD_NEXT, "clBuildProgram");
  cl_context context = NULL;
  clGetProgramInfo(program, CL_PROGRAM_CONTEXT, sizeof context, &context, NULL);
  if (fails("build", context)) return CL_BUILD_PROGRAM_FAILURE;
  return next(program, devices, device_list, options, notify, data);
}
