/* The library is made of c_interface.cpp, in the room itself; a shared library needs a source of its own. */
typedef int capstan_late_shared_has_a_source;
