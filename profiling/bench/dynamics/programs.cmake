# One program for each engine that plays the cases: stadion-dyn-ENGINE.
file(GLOB dynamics_case_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/*.cpp)
list(FILTER dynamics_case_sources EXCLUDE REGEX "/engine_[a-z]+\\.cpp$|/program\\.cpp$")
add_library(stadion_dynamics_cases STATIC ${dynamics_case_sources})
target_link_libraries(stadion_dynamics_cases PUBLIC stadion_options stadion_sanitize)
add_custom_target(dynamics_programs)

function(stadion_dynamics_program ENGINE)
  add_executable(stadion-dyn-${ENGINE} profiling/bench/dynamics/program.cpp profiling/bench/dynamics/engine_${ENGINE}.cpp)
  target_link_libraries(stadion-dyn-${ENGINE} PRIVATE stadion_dynamics_cases ${ARGN})
  add_dependencies(dynamics_programs stadion-dyn-${ENGINE})
endfunction()

stadion_dynamics_program(stadion stadion_dynamics)
