# The flags of every target of this project, as the interface target sightline_flags.
include_guard()
if(NOT CMAKE_C_COMPILER_ID MATCHES "GNU|Clang")
  message(FATAL_ERROR "Sightline is built by gcc or clang; this is ${CMAKE_C_COMPILER_ID}")
endif()
if(NOT SIGHTLINE_WASM)
  set(THREADS_PREFER_PTHREAD_FLAG ON)
  find_package(Threads REQUIRED)
endif()
set(CMAKE_C_STANDARD 11)
set(CMAKE_C_STANDARD_REQUIRED ON)
set(CMAKE_C_EXTENSIONS OFF)

add_library(sightline_flags INTERFACE)
target_compile_definitions(sightline_flags INTERFACE _XOPEN_SOURCE=700
  $<$<NOT:$<BOOL:${SIGHTLINE_BOXES}>>:SLI_WITHOUT_BOXES>)
if(MINGW) # its printf as C has it, and nothing to install beside a program
  target_compile_definitions(sightline_flags INTERFACE __USE_MINGW_ANSI_STDIO=1)
  target_link_options(sightline_flags INTERFACE -static)
else() # files of any size and number where sizes have 32 bits
  target_compile_definitions(sightline_flags INTERFACE _FILE_OFFSET_BITS=64)
endif()
target_compile_options(sightline_flags INTERFACE
  # Contracting a multiply and an add changes the signs that exact predicates compute.
  -ffp-contract=off
  -fvisibility=hidden
  -Wall -Wextra -Wpedantic -Wshadow -Wstrict-prototypes -Wmissing-prototypes -Wvla
  -Wpointer-arith -Wcast-qual -Wundef -Wformat=2
  $<$<BOOL:${SIGHTLINE_WERROR}>:-Werror>)

if(SIGHTLINE_SANITIZE)
  target_compile_options(sightline_flags INTERFACE
    -fsanitize=${SIGHTLINE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer -g)
  target_link_options(sightline_flags INTERFACE -fsanitize=${SIGHTLINE_SANITIZE})
endif()

# Elsewhere than on x86 these instructions are part of what every compiler uses anyway.
if(SIGHTLINE_FMA)
  include(CheckCSourceRuns)
  check_c_source_runs("
    int main(void) {
    #if defined(__x86_64__)
      return !(__builtin_cpu_supports(\"fma\") && __builtin_cpu_supports(\"avx2\"));
    #else
      return 1;
    #endif
    }" SIGHTLINE_MACHINE_IS_HASWELL)
  if(SIGHTLINE_MACHINE_IS_HASWELL)
    target_compile_options(sightline_flags INTERFACE -march=haswell)
    set(machine -march=haswell)
  else()
    message(STATUS "SIGHTLINE_FMA: not an x86 machine with FMA; nothing added")
  endif()
endif()

# gcc's vectorizer contracts all the same, where the machine has instructions for it.
if(CMAKE_C_COMPILER_ID STREQUAL "GNU")
  include(CheckCSourceCompiles)
  string(TOUPPER "${CMAKE_BUILD_TYPE}" configuration)
  set(CMAKE_REQUIRED_FLAGS "${CMAKE_C_FLAGS_${configuration}} ${machine}")
  check_c_source_compiles("
    #if !defined(__FMA__) && !defined(__FMA4__) && !defined(__riscv_vector)
    #error
    #endif
    int main(void) { return 0; }" SIGHTLINE_VECTORIZER_CONTRACTS)
  unset(CMAKE_REQUIRED_FLAGS)
  if(SIGHTLINE_VECTORIZER_CONTRACTS)
    target_compile_options(sightline_flags INTERFACE -fno-tree-vectorize)
  endif()
endif()
