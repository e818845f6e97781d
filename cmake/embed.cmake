# embed_files(TARGET <target> NAME <name> ROOT <dir> FILES <file>...)
# Puts the files into the target as the table `const struct embedded_file <name>_files[]` with
# `const int <name>_file_count`; each entry has the path relative to ROOT, data and size
# (api/embedded.h). The assembler reads the bytes, so any size is cheap.
function(embed_files)
  cmake_parse_arguments(E "" "TARGET;NAME;ROOT" "FILES" ${ARGN})
  set(source "${CMAKE_CURRENT_BINARY_DIR}/embedded_${E_NAME}.c")
  set(text "#include \"api/embedded.h\"\n")
  set(rows "")
  set(index 0)
  foreach(file IN LISTS E_FILES)
    cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" NORMALIZE)
    cmake_path(RELATIVE_PATH file BASE_DIRECTORY "${E_ROOT}" OUTPUT_VARIABLE path)
    set(symbol "embedded_${E_NAME}_${index}")
    string(APPEND text
      "__asm__(\".section .rodata\\n.global ${symbol}\\n.balign 16\\n${symbol}:\\n"
      ".incbin \\\"${file}\\\"\\n.global ${symbol}_end\\n${symbol}_end:\\n.byte 0\\n.previous\\n\");\n"
      "extern const char ${symbol}[], ${symbol}_end[];\n")
    string(APPEND rows "    {\"${path}\", ${symbol}, ${symbol}_end},\n")
    math(EXPR index "${index} + 1")
  endforeach()
  string(APPEND text "const struct embedded_file ${E_NAME}_files[] = {\n${rows}};\n"
    "const int ${E_NAME}_file_count = ${index};\n")
  file(CONFIGURE OUTPUT "${source}" CONTENT "${text}" @ONLY)
  set_source_files_properties("${source}" PROPERTIES OBJECT_DEPENDS "${E_FILES}")
  target_sources(${E_TARGET} PRIVATE "${source}")
endfunction()
