# One way to declare a target of ours: C++20, warnings (as errors), sanitizers.
function(adit_target name)
  target_compile_features(${name} PUBLIC cxx_std_20)
  target_compile_options(${name} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wold-style-cast
    -Wno-maybe-uninitialized -Wno-array-bounds)  # GCC 12 sees these in Eigen's fixed-size vectors where there are none
  if(ADIT_WARNINGS_AS_ERRORS)
    target_compile_options(${name} PRIVATE -Werror)
  endif()
  if(ADIT_FUZZ)
    target_compile_options(${name} PUBLIC -fsanitize=fuzzer-no-link)
  endif()
  if(ADIT_SANITIZE)
    # EIGEN_MALLOC_ALREADY_ALIGNED: PCL's library and ours must free what the other allocated.
    target_compile_definitions(${name} PUBLIC EIGEN_MALLOC_ALREADY_ALIGNED=1)
    target_compile_options(${name} PUBLIC -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
    target_link_options(${name} PUBLIC -fsanitize=address,undefined)
  endif()
endfunction()

# A layer: a static library with its own include root, which holds nothing but the layer's folder. A layer sees its own
# root and those of the layers it links, so an include that runs up or sideways finds no file.
function(adit_layer layer)
  set(root ${PROJECT_BINARY_DIR}/include_roots/${layer})
  file(MAKE_DIRECTORY ${root})
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${layer} ${root}/${layer} SYMBOLIC)
  add_library(adit_${layer} STATIC ${ARGN})
  target_include_directories(adit_${layer} PUBLIC ${root})
  adit_target(adit_${layer})
endfunction()
