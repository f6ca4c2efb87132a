# SPDX-License-Identifier: GPL-3.0-or-later

find_package(Eigen3 REQUIRED NO_MODULE)
find_package(Boost REQUIRED) # headers only
find_package(OpenMP COMPONENTS CXX)
if(DCHARTS_PLUGIN_PYMESHLAB OR DCHARTS_PLUGIN_2025 OR DCHARTS_PLUGIN_2020)
  find_package(Qt5 REQUIRED COMPONENTS Core Gui Widgets Xml OpenGL)
endif()
if(DCHARTS_BUILD_TESTS)
  find_package(GTest REQUIRED)
endif()
