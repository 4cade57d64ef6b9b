capstan_test(engagement DEPENDS engagement)
