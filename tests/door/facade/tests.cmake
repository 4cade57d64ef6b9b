capstan_test(facade DEPENDS facade service)
