capstan_test(verify DEPENDS verify mechanics)
