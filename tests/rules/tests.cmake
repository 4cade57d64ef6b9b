capstan_test(rules DEPENDS rules)
