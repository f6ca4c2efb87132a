# SPDX-License-Identifier: GPL-3.0-or-later
# Windows and macOS, where nobody has built the plugins yet: the user gives the source trees, and the library that a
# plugin is linked with.

set(MESHLAB_COMMON_LIBRARY "" CACHE FILEPATH "MeshLab's own library meshlab-common to link the plugins with")

function(dcharts_find_meshlab version variable header)
  if(NOT EXISTS "${${variable}}/${header}")
    message(WARNING "There are no headers of MeshLab ${version}, so its plugins are not built. "
                    "Set ${variable} to a source tree of MeshLab ${version} that has its vcglib.")
    set(${variable} "" PARENT_SCOPE)
  endif()
endfunction()

function(dcharts_link_host target)
  if(NOT MESHLAB_COMMON_LIBRARY)
    message(FATAL_ERROR "Set MESHLAB_COMMON_LIBRARY to the library meshlab-common of your MeshLab.")
  endif()
  target_link_libraries(${target} PRIVATE ${MESHLAB_COMMON_LIBRARY})
endfunction()
