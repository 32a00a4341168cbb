# One test per document that has commands, so that a failure names it; and one for all links.
find_program(BOXWOOD_PYTHON3 python3)
if(BOXWOOD_PYTHON3)
  file(GLOB_RECURSE documents CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/docs/*.md)
  foreach(document README.md ${documents})
    file(STRINGS ${PROJECT_SOURCE_DIR}/${document} commands REGEX "^```sh" LIMIT_COUNT 1)
    if(commands)
      add_test(NAME Docs.CommandsRun.${document}
               COMMAND ${BOXWOOD_PYTHON3} ${CMAKE_CURRENT_LIST_DIR}/check.py commands $<TARGET_FILE:boxwood_cli> ${PROJECT_SOURCE_DIR}/${document})
      set_tests_properties(Docs.CommandsRun.${document} PROPERTIES TIMEOUT 600)
    endif()
  endforeach()
  add_test(NAME Docs.LinksLeadSomewhere COMMAND ${BOXWOOD_PYTHON3} ${CMAKE_CURRENT_LIST_DIR}/check.py links ${PROJECT_SOURCE_DIR})
endif()
