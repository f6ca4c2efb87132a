# SPDX-License-Identifier: GPL-3.0-or-later
# cmake -DEXAMPLES=write_examples -DREFERENCE=write_reference -DTABLE=write_python_texts -DSOURCE=. -DFOLDER=scratch -P CheckGenerated.cmake
# Fails when example scripts, reference or table are not what the table of filters gives.

# check(PROGRAM ARGUMENT FILE...): PROGRAM writes to ARGUMENT in the scratch folder; the files are relative to it.
function(check program argument)
  get_filename_component(folder ${FOLDER}/${argument} DIRECTORY)
  file(MAKE_DIRECTORY ${folder} ${FOLDER}/examples)
  execute_process(COMMAND ${program} ${FOLDER}/${argument} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${program} failed")
  endif()
  foreach(name ${ARGN})
    execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files --ignore-eol ${FOLDER}/${name} ${SOURCE}/${name}
                    RESULT_VARIABLE result)
    if(NOT result EQUAL 0)
      message(SEND_ERROR "${name} is not current; run: ${program} ${argument}")
    endif()
  endforeach()
endfunction()

check(${EXAMPLES} examples examples/texture_atlas.mlx examples/stages.mlx examples/paper.mlx examples/pattern.mlx)
check(${REFERENCE} docs/filters.md docs/filters.md)
check(${TABLE} docs/filters.json docs/filters.json)
