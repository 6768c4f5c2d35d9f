# 64-bit ARM with Debian's cross compiler (deploy/setup --arm). For libraries only: of Eigen, Highway, fmt, CLI11 and JSON
# this machine's own packages are found, whose headers are the same for every machine; their libraries are not linked.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
file(GLOB PELAGOS_HOST_PACKAGES /usr/lib/*-linux-gnu/cmake)
list(APPEND CMAKE_PREFIX_PATH ${PELAGOS_HOST_PACKAGES})
