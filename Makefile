# Thin names for the CMake workflow presets of CMakePresets.json.
.PHONY: reproduce test bench dev sanitize native clean

reproduce test bench dev sanitize native:
	cmake --workflow --preset $@

clean:
	rm -rf build results
