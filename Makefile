# make deps      install what is missing (Debian packages)   make demo     calibrate Boryeong shale on large grains
# make deps-all  also what no test is left out without       make test     build and run all tests
# make python    the Python package, into build/python-env   make install  program, pages, completion, documents: PREFIX=, DESTDIR=
# make package   a Debian package, and the source tarball    make package-check  install, try and remove it on a bare Debian 12
# make windows   the program for Windows, as one .exe and a .zip    make windows-check  try it under wine
# make browser-lab  the page with the program inside, one file without a server   make browser-check  its numbers, in node (neither in CI: a fifth of an hour of CPU)
# make aarch64   the program for 64-bit ARM under Linux             make aarch64-check    its numbers, under qemu
# make docs      the documents as a searchable site          make pictures those of gallery and README
# make web       bundle the pages anew
# make rocks     calibrate every measured rock of data/rocks, and predict: the cards, docs/rocks.md (100 minutes of CPU, resumed)
# make lint      format, floors, functions, comments         make tidy     clang-tidy
# make sanitize  tests under the sanitizers                  make coverage lines that the tests run, room by room
# make fuzz      every reader under libFuzzer                make bench    measure the speed of the press
BUILD := build/release
JOBS := $(shell nproc)
SUDO := $(shell [ "$$(id -u)" = 0 ] || echo sudo)
# Of a preset (CMakePresets.json): build it, test it.
made = cmake --preset $(1) >/dev/null && cmake --build build/$(1) -j $(JOBS)
tested = ctest --test-dir build/$(1) --output-on-failure -j $(JOBS)
QUICK := -LE 'bench|soak|paper'

PACKAGES := g++ cmake ninja-build ccache libeigen3-dev libtomlplusplus-dev libcli11-dev libfmt-dev libsqlite3-dev zlib1g-dev \
            libzip-dev libpugixml-dev libboost-dev nlohmann-json3-dev libgtest-dev libgmock-dev libxxhash-dev libbenchmark-dev \
            clang-format clang-tidy python3
PYTHON := pybind11-dev python3-dev python3-numpy python3-venv python3-pip python3-setuptools python3-wheel
SITE := python3-sphinx python3-myst-parser furo
# For figure, film and study --mpi, the test of a full disk, notebooks, the tests of manual pages and completion.
MORE := gnuplot-nox fonts-dejavu-core ffmpeg libopenmpi-dev openmpi-bin util-linux mount $(PYTHON) python3-pandas \
        python3-matplotlib python3-nbclient python3-ipykernel man-db mandoc zsh fish $(SITE)
deps-all: PACKAGES += $(MORE)
deps-docs: PACKAGES += $(SITE)
deps-soak: PACKAGES += python3-vtk9
deps-clang: PACKAGES += clang libclang-rt-14-dev
deps-coverage: PACKAGES += gcovr
deps-windows: PACKAGES += g++-mingw-w64-x86-64-posix dpkg-dev tcl
windows-check: PACKAGES += wine64 wine
deps-inside: PACKAGES += clang-16 emscripten dpkg-dev tcl
deps-aarch64: PACKAGES += g++-aarch64-linux-gnu dpkg-dev tcl
aarch64-check: PACKAGES += qemu-user
deps-package: PACKAGES += dpkg-dev file lintian mmdebstrap
python: PACKAGES += $(PYTHON)

.PHONY: $(shell sed -n 's/^\([a-z][a-z -]*\):.*/\1/p' Makefile)

deps:
	@missing=$$(for p in $(PACKAGES); do dpkg -s $$p 2>/dev/null | grep -q '^Status: install ok installed' || echo $$p; done); \
	echo "deps:" $${missing:-nothing is missing}; test -z "$$missing" || { $(SUDO) apt-get update -qq && \
	  DEBIAN_FRONTEND=noninteractive $(SUDO) apt-get install -y -qq --no-install-recommends $$missing; }
deps-all deps-docs deps-soak deps-clang deps-coverage deps-package deps-windows deps-inside deps-aarch64: deps

build:
	@$(call made,release)

# What a user needs; `build` makes tests and benchmarks too.
program:
	@$(call made,release) --target phyllite

demo: deps program
	@mkdir -p results
	@$(BUILD)/phyllite calibrate examples/demo/boryeong.toml --effort quick --out results/demo --resume >results/demo.txt
	@awk -v RS= -F'\n' 'END { print $$1; print $$NF }' results/demo.txt
	@echo "The page: results/demo/report.html, for your browser. Everything that was printed: results/demo.txt"

demo-twin: deps program
	$(BUILD)/phyllite calibrate examples/twin/twin.toml --out results/twin --resume

demo-press: deps program
	$(BUILD)/phyllite run examples/paper/press.toml --out results/paper

# Into a virtual environment that sees Debian's NumPy.
VENV ?= build/python-env
python: deps
	@$(call made,release) --target phyllite_python
	@test -x $(VENV)/bin/python || /usr/bin/python3 -m venv --system-site-packages $(VENV)
	@cmake --install $(BUILD) --component python \
	  --prefix "$$($(VENV)/bin/python -c 'import sysconfig; print(sysconfig.get_path("platlib"))')" >/dev/null
	@$(VENV)/bin/python -c 'import phyllite; print("python: phyllite", phyllite.__version__, "is installed in $(VENV): start $(VENV)/bin/python")'

# As `cmake --install`: a plain copy, which remembers no prefix. What was copied stands in install_manifest_program.txt.
PREFIX := /usr/local
install: deps
	@$(call made,release) --target manual
	@DESTDIR="$(DESTDIR)" cmake --install $(BUILD) --prefix "$(PREFIX)" --component program | tail -1
	@echo "install: phyllite is in $(DESTDIR)$(PREFIX)"

# DEBFULLNAME and DEBEMAIL name who stands for it. What lintian says where nobody does, and of a package that no bug of Debian
# asked for, is no fault here.
UNNAMED := bogus-mail-host,bogus-mail-host-in-debian-changelog,root-in-contact,initial-upload-closes-no-bugs
package: deps-package
	@$(call made,release) --target manual
	@cd $(BUILD) && cpack >cpack.txt || { cat cpack.txt; exit 1; }
	@version=$$($(BUILD)/phyllite --version | sed 's/ /-/; s/\.changed//'); \
	  git archive --prefix=$$version/ -o $(BUILD)/$$version.tar.gz HEAD
	@ls -l $(BUILD)/phyllite_*.deb $(BUILD)/phyllite-*.tar.gz
	@lintian --fail-on error,warning --suppress-tags $(UNNAMED) $(BUILD)/phyllite_*.deb

# Needs root, and a Debian mirror.
package-check: package
	@$(SUDO) bash packaging/check.sh $(BUILD)/phyllite_*.deb

# Libraries are compiled from Debian's sources (tools/sources.sh), which come once. What users unpack is the .zip.
windows: deps-windows
	@sh tools/sources.sh build/sources
	@$(call made,windows) --target phyllite
	@cd build/windows && rm -f phyllite-*-windows.zip && cpack >cpack.txt || { cat cpack.txt; exit 1; }
	@ls -l build/windows/phyllite.exe build/windows/phyllite-*.zip

# What no other build compiles, in seconds.
windows-files: deps-windows
	@for f in src/system/*_windows.cpp; do \
	  x86_64-w64-mingw32-g++-posix -std=c++20 -D_WIN32_WINNT=0x0A00 -Wall -Wextra -Werror -fsyntax-only -Isrc $$f || exit 1; done

windows-check: windows program
	@python3 tools/windows_check.py $(CHECKS)

# For a browser, by emscripten (docs/decisions/0026-in-the-browser.md). Chromium tries the page in `make browser`.
browser-program: deps-inside
	@sh tools/sources.sh build/sources
	@$(call made,browser) --target phyllite phyllite_threads

browser-check: browser-program program
	@python3 tools/browser_check.py $(CHECKS)

browser-lab: browser-program
	@python3 tools/browser_lab.py build/browser build/browser-lab

# Likewise for 64-bit ARM under Linux.
aarch64: deps-aarch64
	@sh tools/sources.sh build/sources
	@$(call made,aarch64) --target phyllite
	@ls -l build/aarch64/phyllite

aarch64-check: aarch64 program
	@python3 tools/aarch64_check.py $(CHECKS)

# What users can have is tested: a tool that is missing is installed first.
test: PACKAGES += $(MORE)
test: deps build
	@python3 tools/check_floors.py
	@$(call tested,release) $(QUICK)

soak: deps-soak build
	@ctest --test-dir $(BUILD) --output-on-failure -L soak

bench: build
	PHY_BENCH_TESTS=1 $(BUILD)/bench_engine
	$(BUILD)/bench_statics
	$(BUILD)/bench_flat_joint

lint:
	@git ls-files '*.hpp' '*.cpp' | xargs clang-format --dry-run -Werror
	@python3 tools/check_floors.py
	@python3 tools/tools_test.py --quiet
	@python3 tools/check_functions.py
	@python3 tools/status.py --check
	@python3 tools/check_docs.py

# By the commands of a build without precompiled headers, which need not be run.
tidy:
	@cmake --preset tidy >/dev/null
	@git ls-files 'src/*.cpp' | grep -v '\.test\.' | xargs -P $(JOBS) -n 2 clang-tidy -p build/tidy --quiet 2>/dev/null

clang: deps-clang
	@$(call made,clang)

# The same bits by another compiler.
clang-hash: deps-clang
	@$(call made,clang) --target one_hash
	build/clang/one_hash --gtest_filter='GoldenHashes.*'

# Studies and calibrations over MPI ranks, built and tested beside the usual build.
mpi:
	@$(call made,mpi) --target phyllite test_x_mpi
	@$(call tested,mpi) -L mpi

# Every reader of outside input (tests/fuzz/readers.hpp) for as many minutes of CPU; READERS="recipe rock" for some.
MINUTES := 10
fuzz: deps-clang
	@$(call made,fuzz) --target fuzz
	@python3 tools/fuzz.py build/fuzz $(MINUTES) $(READERS)

# All tests of `make test` under address and undefined, then under thread those of the rooms that start threads. The library
# that counts events is loaded before the sanitizer's, which is meant.
THREADED := test_base test_statics test_study test_calibrate test_gui test_x_determinism
sanitize: asan
	@$(MAKE) --no-print-directory tsan
tsan: deps
	@$(call made,tsan) --target $(THREADED)
	@$(call tested,tsan) -R '^($(subst $() ,|,$(THREADED)))$$'
asan: deps
	@$(call made,asan)
	@find build/asan -name '*.gcda' -delete
	@ASAN_OPTIONS=verify_asan_link_order=0 $(call tested,asan) $(QUICK)

# Tests of the rooms that read, these rooms under address and undefined: what fits into continuous integration.
sanitize-short: deps
	@$(call made,watched) --target test_base test_records test_io test_rock test_x_fuzz
	@$(call tested,watched) -L watched

# Lines that the last `make asan` ran.
coverage: deps-coverage
	@test -d build/asan || $(MAKE) asan
	@python3 tools/coverage.py build/asan

# After a change that is meant to change bits: writes tests/recorded.txt anew and REASON into CHANGELOG.md.
record: build
	@python3 tools/record.py $(BUILD) "$(REASON)"

# Pages of numbers, each from the studies of its folder in examples: docs/paper.md, docs/evidence.md, docs/reliability-tables.md.
paper evidence reliability: program
	python3 tools/reproduce.py $@ $(BUILD)/phyllite

# What models of rock reach: data/maps, which the program takes in, and docs/reach-tables.md. What the tables have is kept;
# without any some three and a half hours of CPU.
maps: build
	@mkdir -p results
	$(BUILD)/maps data/maps results/maps.sqlite
	python3 tools/maps.py data/maps docs/reach-tables.md

# Measured rocks: data/rocks/NAME/card.json and calibrated.toml, docs/rocks.md, docs/boryeong.md, measured/rocks.csv. What is finished in
# results/rocks is kept. The program takes the cards in, so that it is built again.
rocks: program
	python3 tools/rocks.py $(BUILD)/phyllite
	python3 tools/status.py
	@$(call made,release) --target phyllite

# Beside Yade (Debian: yade), some minutes, never part of CI: the paper's specimen in both, one core each; and its laws made
# equal, for bench/peers/equal.csv, which `make evidence` quotes.
bench-peers: build
	python3 bench/peers/run.py $(BUILD)/phyllite
yade: program
	python3 bench/peers/equal.py $(BUILD)/phyllite

# Pages that the program writes, then all as a site in build/site.
docs: deps-docs build
	for of in recipe study rock; do $(BUILD)/phyllite $$of --reference || exit 1; done > docs/reference.md
	$(BUILD)/phyllite rock --tables > docs/tables.md
	$(BUILD)/phyllite calibrate --reference > docs/calibration-tables.md
	$(BUILD)/phyllite run --reference > docs/result-tables.md
	$(BUILD)/phyllite verify --markdown > docs/verification.md
	python3 tools/status.py
	@sphinx-build -q -W --keep-going -b html -c docs/site -d build/doctrees docs build/site
	@echo "docs: build/site/index.html, for any browser, without a network"

# Pictures of the gallery and the README from tests of their own, the moving one from results/rocks; `make paper` draws its own.
pictures: program
	@python3 tools/pictures.py $(BUILD)/phyllite

# The pages of report.html and of phyllite gui, bundled from web/src: both are committed, so that building needs no node.
web:
	@cd web && npm ci --ignore-scripts --silent --no-audit --no-fund && npx tsc --noEmit && node build.mjs

# Both pages in Debian's Chromium; need node and chromium beside `make deps`.
browser: build web
	@PHYLLITE=$(BUILD)/phyllite node --test tests/browser/*.test.mjs

clean:
	rm -rf build results
