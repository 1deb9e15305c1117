# SPDX-FileCopyrightText: 2026 the Stucco authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Every library the project stands on; the versions are those of Debian 12.
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(TBB REQUIRED)
find_package(OpenCV 4.6 REQUIRED COMPONENTS core imgproc imgcodecs features2d calib3d flann
  quality video dnn)
find_package(Ceres 2.1 REQUIRED)
find_package(glog 0.6 REQUIRED)
find_package(CGAL 5.5 REQUIRED)
# Boost.Graph, headers only. survey gets its include folder through CGAL.
find_package(Boost 1.74 REQUIRED)
find_package(embree 3.13 REQUIRED)
find_package(assimp 5.2 REQUIRED)
find_package(JPEG REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(exiv2 REQUIRED IMPORTED_TARGET exiv2)
pkg_check_modules(xxhash REQUIRED IMPORTED_TARGET libxxhash)
find_package(GDAL 3.6 REQUIRED)
find_package(pugixml REQUIRED)
pkg_check_modules(zip REQUIRED IMPORTED_TARGET libzip)
pkg_check_modules(pcl_kdtree REQUIRED IMPORTED_TARGET pcl_kdtree)
find_package(CLI11 REQUIRED)
find_package(tomlplusplus REQUIRED)

if(BUILD_TESTING)
  find_package(GTest REQUIRED)
  include(GoogleTest)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
endif()
