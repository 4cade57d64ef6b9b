capstan_test(service DEPENDS service transport report)
