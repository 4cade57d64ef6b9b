capstan_test(exchange DEPENDS base geometry model p21 exchange)
