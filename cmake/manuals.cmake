# cmake -DPROGRAM=.../meninas -DFOLDER=... -P manuals.cmake: the manual pages and the completions of shells,
# as the program writes them, in the tree in which they are installed.
file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER}/man/man1 ${FOLDER}/bash ${FOLDER}/zsh ${FOLDER}/fish)

function(write_page file)
  execute_process(COMMAND ${PROGRAM} help ${ARGN} OUTPUT_FILE ${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

write_page(${FOLDER}/man/man1/meninas.1 --man)
execute_process(COMMAND ${PROGRAM} help --markdown OUTPUT_VARIABLE options COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "\n## meninas [a-z]+" commands "${options}")
foreach(heading IN LISTS commands)
  string(REGEX REPLACE "\n## meninas " "" command "${heading}")
  write_page(${FOLDER}/man/man1/meninas-${command}.1 --man ${command})
endforeach()

# As distributions have them; without the date of the file, so that the same pages are the same bytes.
find_program(gzip gzip)
if(gzip)
  file(GLOB pages ${FOLDER}/man/man1/*.1)
  execute_process(COMMAND ${gzip} -9 --no-name --force ${pages} COMMAND_ERROR_IS_FATAL ANY)
endif()

write_page(${FOLDER}/bash/meninas --completion bash)
write_page(${FOLDER}/zsh/_meninas --completion zsh)
write_page(${FOLDER}/fish/meninas.fish --completion fish)
