capstan_test(memo DEPENDS memo)
