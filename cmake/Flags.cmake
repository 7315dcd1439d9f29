# One interface target carries what every target of ours compiles with.
add_library(vigil_flags INTERFACE)
target_include_directories(vigil_flags INTERFACE ${CMAKE_SOURCE_DIR})
target_compile_options(vigil_flags INTERFACE -Wall -Wextra -Wconversion -Wno-sign-conversion -Wshadow
                       -Wno-missing-field-initializers  # designated initialisers leave out what is free
                       $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)  # gcc 12 is wrong about std::string and std::optional
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(vigil_flags INTERFACE -fpch-preprocess)
  if(VIGIL_UNITY)  # gcc 12 is wrong about std::string here, too, where many files meet; ordinary builds warn
    target_compile_options(vigil_flags INTERFACE -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread)
  endif()
  # Templates fill the compiler's heap with what is never freed: where there is memory, collecting it a tenth as often
  # saves a tenth of a build's time.
  cmake_host_system_information(RESULT VIGIL_MEMORY QUERY TOTAL_PHYSICAL_MEMORY)  # MiB
  if(VIGIL_MEMORY GREATER 7000)
    target_compile_options(vigil_flags INTERFACE "SHELL:--param ggc-min-expand=400" "SHELL:--param ggc-min-heapsize=400000")
  endif()
endif()
if(VIGIL_WERROR)
  target_compile_options(vigil_flags INTERFACE -Werror)
endif()
if(VIGIL_NATIVE)
  target_compile_options(vigil_flags INTERFACE -march=native)
endif()
if(VIGIL_SANITIZE)
  target_compile_options(vigil_flags INTERFACE -fsanitize=${VIGIL_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(vigil_flags INTERFACE -fsanitize=${VIGIL_SANITIZE})
endif()
