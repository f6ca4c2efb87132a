# SPDX-License-Identifier: GPL-3.0-or-later
# Everything about the hosts that is for Linux only.

# dcharts_find_meshlab(version variable header): sets `variable` to a MeshLab source tree: the one the user gave, else
# the one in the cache, which scripts/fetch-meshlab-headers.sh fills. Empty when there is none; then a warning says so.
function(dcharts_find_meshlab version variable header)
  set(tree "${${variable}}")
  if(tree)
    if(NOT EXISTS "${tree}/${header}")
      message(FATAL_ERROR "${variable}: ${tree} is no source tree of MeshLab ${version}, it has no ${header}")
    endif()
    get_filename_component(tree "${tree}" ABSOLUTE BASE_DIR "${CMAKE_BINARY_DIR}")
  else()
    if(DEFINED ENV{DCHARTS_CACHE})
      set(cache "$ENV{DCHARTS_CACHE}")
    elseif(DEFINED ENV{XDG_CACHE_HOME})
      set(cache "$ENV{XDG_CACHE_HOME}/dcharts")
    else()
      set(cache "$ENV{HOME}/.cache/dcharts")
    endif()
    set(tree "${cache}/meshlab-${version}")
    if(NOT EXISTS "${tree}/${header}" AND DCHARTS_FETCH_HEADERS)
      message(STATUS "Fetching the headers of MeshLab ${version}")
      execute_process(COMMAND bash "${PROJECT_SOURCE_DIR}/scripts/fetch-meshlab-headers.sh" ${version} OUTPUT_QUIET)
    endif()
    if(NOT EXISTS "${tree}/${header}")
      message(WARNING "There are no headers of MeshLab ${version}, so its plugins are not built. "
                      "Set ${variable} to a source tree of MeshLab ${version} that has its vcglib.")
      set(tree "")
    endif()
  endif()
  if(tree)
    message(STATUS "MeshLab ${version}: ${tree}")
  endif()
  set(${variable} "${tree}" PARENT_SCOPE)
endfunction()

# The plugins take MeshLab's own symbols from the host that loads them. To say so, each needs an entry for
# libmeshlab-common.so; an empty library of that name gives it, so no host has to be installed for the build.
file(WRITE ${CMAKE_BINARY_DIR}/host_stub/empty.cpp "")
add_library(dcharts_host_stub SHARED ${CMAKE_BINARY_DIR}/host_stub/empty.cpp)
set_target_properties(
  dcharts_host_stub PROPERTIES OUTPUT_NAME meshlab-common LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/host_stub)

# Links a plugin so that its host can load it from any folder.
function(dcharts_link_host target)
  target_link_libraries(${target} PRIVATE -Wl,--push-state,--no-as-needed dcharts_host_stub -Wl,--pop-state)
  set_target_properties(${target} PROPERTIES SKIP_BUILD_RPATH ON SKIP_INSTALL_RPATH ON)
endfunction()
