capstan_test(toolpath DEPENDS toolpath)
