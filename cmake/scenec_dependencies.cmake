# Every third-party library, found in one place. The Debian packages that bring them are listed
# once, in ./dev.

find_package(Threads REQUIRED)
find_package(ZLIB REQUIRED)
find_package(PkgConfig REQUIRED)
find_package(fmt REQUIRED)
find_package(pegtl REQUIRED)
find_package(CLI11 REQUIRED)
find_package(OpenEXR REQUIRED)
find_package(PNG REQUIRED)
find_package(libjpeg-turbo REQUIRED)
find_package(nlohmann_json REQUIRED)
pkg_check_modules(xxhash REQUIRED IMPORTED_TARGET libxxhash)
pkg_check_modules(stb REQUIRED IMPORTED_TARGET stb)
pkg_check_modules(hwy REQUIRED IMPORTED_TARGET libhwy)
