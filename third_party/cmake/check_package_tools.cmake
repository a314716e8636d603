# Run by cpack before it packs: without these tools it would make a package that does not name the libraries it needs.
foreach(tool dpkg-shlibdeps file)
  find_program(found_${tool} ${tool})
  if(NOT found_${tool})
    message(FATAL_ERROR "Packing needs ${tool}: apt-get install dpkg-dev file")
  endif()
endforeach()
