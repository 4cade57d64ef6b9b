# What the planner makes of real files, from the file to the program.
capstan_test(corpus DEPENDS pipeline service json controls verify exchange)
