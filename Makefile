# Thin names for the CMake workflow presets of CMakePresets.json.
.PHONY: all command reproduce docs test campaign bench dev sanitize native package install uninstall clean

all: command

command reproduce docs test campaign bench dev sanitize native package:
	cmake --workflow --preset $@

# After each change: all tests with the label unit, or with ROOM=solvers/flow, ROOM=app/study, ROOM=python those of one room.
check:
ifdef ROOM
	test -e build/default/build.ninja || cmake --preset default
	cmake --build build/default --target check_$(firstword $(subst /, ,$(ROOM)))
	ctest --test-dir build/default -j 2 --no-tests=error --output-on-failure -L '^$(ROOM)(/|$$)'
else
	cmake --workflow --preset check
endif

PREFIX ?= /usr/local

# All that was built goes below PREFIX, as its list goes to a file of its own, since the next install overwrites it.
install:
	test -e build/default/build.ninja || cmake --preset default
	cmake --build --preset installed
	cmake --install build/default --prefix $(PREFIX)
	cp build/default/install_manifest.txt build/default/installed_files.txt

uninstall:
	cmake -D list=build/default/installed_files.txt -P cmake/uninstall.cmake

clean:
	rm -rf build results
