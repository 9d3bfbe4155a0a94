# SPDX-License-Identifier: Apache-2.0
# Device code (option DISMANTLE_CUDA): needs nvcc, and no GPU. The runtime is linked statically: what is built runs, on the CPU, where
# there is no driver. The flags that keep the device's bits those of the CPU are with those of C++ in DismantleBuild.
set(CMAKE_CUDA20_STANDARD_COMPILE_OPTION "-std=c++20")  # CMake 3.25 does not know it
set(CMAKE_CUDA20_EXTENSION_COMPILE_OPTION "-std=c++20")
if(NOT CMAKE_CUDA_ARCHITECTURES)
  set(CMAKE_CUDA_ARCHITECTURES 80-real 90)  # and, as PTX, all that came later
endif()
include(CheckLanguage)
check_language(CUDA)
if(NOT CMAKE_CUDA_COMPILER)
  message(FATAL_ERROR "DISMANTLE_CUDA needs nvcc (none was found); install the CUDA toolkit or leave the option off")
endif()
enable_language(CUDA)
set(CMAKE_CUDA_STANDARD 20)
set(CMAKE_CUDA_STANDARD_REQUIRED ON)
set(CMAKE_CUDA_RUNTIME_LIBRARY Static)
set(CMAKE_CUDA_FLAGS "${CMAKE_CUDA_FLAGS} --expt-relaxed-constexpr")
