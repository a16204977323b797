// CL/opencl.hpp, configured, and its errors in words.
#pragma once

#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_ENABLE_EXCEPTIONS
#include <CL/opencl.hpp>
#include <string>
#include <vector>

namespace gearsweep {

// "CL_OUT_OF_RESOURCES, -5".
std::string describe_code(cl_int code);

// "doing failed: clEnqueueNDRangeKernel (CL_OUT_OF_RESOURCES, -5)".
std::string describe_error(const std::string& doing, const cl::Error& error);

// The devices behind list_devices(), in the same order.
std::vector<cl::Device> find_devices();

}  // namespace gearsweep
