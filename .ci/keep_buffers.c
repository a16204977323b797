// Put before OpenCL by LD_PRELOAD: a buffer that is given back stays.
int clReleaseMemObject(void* buffer) {
  (void)buffer;
  return 0;
}
