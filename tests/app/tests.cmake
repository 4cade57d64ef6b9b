capstan_test(app DEPENDS base geometry model p21 exchange motion output app)
