capstan_test(p21 DEPENDS p21)
