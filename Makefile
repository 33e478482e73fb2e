# Thin names for the CMake workflow presets of CMakePresets.json.
.PHONY: command reproduce test bench dev sanitize native clean

command reproduce test bench dev sanitize native:
	cmake --workflow --preset $@

clean:
	rm -rf build results
