capstan_test(optimise DEPENDS optimise optimise_solvers)
