capstan_test(controls DEPENDS controls)
