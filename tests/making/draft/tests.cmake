capstan_test(draft DEPENDS draft)
