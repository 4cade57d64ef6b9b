capstan_test(tooling DEPENDS tooling)
