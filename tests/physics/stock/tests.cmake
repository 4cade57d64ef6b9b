capstan_test(stock DEPENDS stock)
