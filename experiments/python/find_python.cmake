# Sets DELISO_PYTHON_EXECUTABLE to the first Python 3 that has pybind11 and numpy; empty: there is none.
set(DELISO_PYTHON_EXECUTABLE "")
foreach(candidate "${Python_EXECUTABLE}" python3 /usr/bin/python3)
  if(candidate AND NOT DELISO_PYTHON_EXECUTABLE)
    execute_process(COMMAND ${candidate} -c "import numpy, pybind11, sys; print(sys.executable)" RESULT_VARIABLE result
      OUTPUT_VARIABLE executable OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(result EQUAL 0)
      set(DELISO_PYTHON_EXECUTABLE ${executable})
    endif()
  endif()
endforeach()
