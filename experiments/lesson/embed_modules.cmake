# Writes ${OUTPUT}, a source file that holds the modules of the page (${FOLDER}/modules.txt lists them) as strings, so that
# the program needs no file beside it. Runs at build time, when a module has changed. Strings with their lengths: counted
# by the compiler, letter by letter, they are too long for clang++.
set(text "// Written by the build.\n#include \"experiments/lesson/lesson_modules.h\"\n\nnamespace deliso {\n")
string(APPEND text "\nnamespace {\nusing namespace std::literals;\nconstexpr LessonModule kModules[] = {\n")
file(STRINGS ${FOLDER}/modules.txt names)
foreach(name IN LISTS names)
  file(READ ${FOLDER}/${name} module)
  string(FIND "${module}" ")~module\"" end)
  if(NOT end EQUAL -1)
    message(FATAL_ERROR "${name} holds the sequence that ends it in ${OUTPUT}")
  endif()
  string(APPEND text "{\"${name}\", R\"~module(${module})~module\"sv},\n")
endforeach()
string(APPEND text "};\n}  // namespace\n\nstd::span<const LessonModule> lesson_modules() { return kModules; }\n\n}  // namespace deliso\n")
file(WRITE ${OUTPUT} "${text}")
