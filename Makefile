# Thin names for the CMake workflow presets of CMakePresets.json.
.PHONY: all command reproduce docs check test campaign bench dev sanitize native package install uninstall clean

all: command

command reproduce docs check test campaign bench dev sanitize native package:
	cmake --workflow --preset $@

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
