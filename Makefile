# Thin names for the CMake workflow presets of CMakePresets.json.
.PHONY: command reproduce docs test bench dev sanitize native clean

command reproduce docs test bench dev sanitize native:
	cmake --workflow --preset $@

clean:
	rm -rf build results
