# make deps     install what is missing (Debian packages)    make demo    calibrate the twin rock, print the tables
# make deps-all also what no test is left out without        make test    build and run all tests
# make python   the Python package, into build/python-env
# make install  program, manual pages, completion, documents: PREFIX=/usr/local, DESTDIR=
# make package  a Debian package                          make package-check  install, try and remove it on a bare Debian 12
# make docs     the documents as a searchable site, build/site
# make web      bundle the pages anew                         make browser look at them in Chromium
# make fuzz     every reader under libFuzzer                  make bench   measure the speed of the press
# make sanitize tests under the sanitizers                    make coverage  lines that the tests run, room by room
# make tidy     clang-tidy                                    make clang   build all with clang, warnings are errors
BUILD := build/release
JOBS := $(shell nproc)
PACKAGES := g++ cmake ninja-build ccache libeigen3-dev libtomlplusplus-dev libcli11-dev libfmt-dev \
            libsqlite3-dev zlib1g-dev libzip-dev libpugixml-dev libboost-dev nlohmann-json3-dev libgtest-dev libgmock-dev libxxhash-dev libbenchmark-dev clang-format clang-tidy python3
# For phyllite figure, film and study --mpi only, for the test of a full disk, for the Python package and its notebooks.
MORE = gnuplot-nox fonts-dejavu-core ffmpeg libopenmpi-dev openmpi-bin util-linux mount $(PYTHON) python3-pandas python3-matplotlib \
       python3-nbclient python3-ipykernel
# For the tests of manual pages and completion.
MORE += man-db mandoc zsh fish
# For the documents as a site.
SITE := python3-sphinx python3-myst-parser furo
MORE += $(SITE)
# For the Python package.
PYTHON := pybind11-dev python3-dev python3-numpy python3-venv
SUDO := $(shell [ "$$(id -u)" = 0 ] || echo sudo)

.PHONY: deps deps-all deps-docs build program install package package-check deps-package python demo demo-press test soak deps-soak bench paper evidence reliability maps bench-peers mpi yade clang-hash fuzz sanitize asan tsan sanitize-short coverage clang deps-clang deps-coverage lint tidy record docs web browser clean

deps:
	@missing=""; for p in $(PACKAGES); do \
	  dpkg-query -W -f='$${Status}' $$p 2>/dev/null | grep -q 'ok installed' || missing="$$missing $$p"; done; \
	if [ -z "$$missing" ]; then echo "deps: nothing is missing"; else \
	  echo "deps: installing$$missing"; \
	  $(SUDO) apt-get update -qq && DEBIAN_FRONTEND=noninteractive $(SUDO) apt-get install -y -qq --no-install-recommends $$missing; fi

deps-all: PACKAGES += $(MORE)
deps-all: deps

build:
	@cmake --preset release >/dev/null && cmake --build $(BUILD) -j $(JOBS)

# What a user needs; `build` makes tests and benchmarks too.
program:
	@cmake --preset release >/dev/null && cmake --build $(BUILD) -j $(JOBS) --target phyllite

# Into a virtual environment that sees Debian's NumPy.
VENV ?= build/python-env
python: PACKAGES += $(PYTHON)
python: deps
	@cmake --preset release >/dev/null && cmake --build $(BUILD) -j $(JOBS) --target phyllite_python
	@test -x $(VENV)/bin/python || /usr/bin/python3 -m venv --system-site-packages $(VENV)
	@cmake --install $(BUILD) --component python \
	  --prefix "$$($(VENV)/bin/python -c 'import sysconfig; print(sysconfig.get_path("platlib"))')" >/dev/null
	@$(VENV)/bin/python -c 'import phyllite; print("python: phyllite", phyllite.__version__, "is installed in $(VENV): start $(VENV)/bin/python")'

# As `cmake --install`: a plain copy, which remembers no prefix. What was copied stands in install_manifest_program.txt.
PREFIX := /usr/local
install: deps
	@cmake --preset release >/dev/null && cmake --build $(BUILD) -j $(JOBS) --target manual
	@DESTDIR="$(DESTDIR)" cmake --install $(BUILD) --prefix "$(PREFIX)" --component program | tail -1
	@echo "install: phyllite is in $(DESTDIR)$(PREFIX)"

deps-package: PACKAGES += dpkg-dev file lintian mmdebstrap
deps-package: deps

# DEBFULLNAME and DEBEMAIL name who stands for it. What lintian says where nobody does, and of a package that no bug of Debian
# asked for, is no fault here.
UNNAMED := bogus-mail-host,bogus-mail-host-in-debian-changelog,root-in-contact,initial-upload-closes-no-bugs
package: deps-package
	@cmake --preset release >/dev/null && cmake --build $(BUILD) -j $(JOBS) --target manual
	@cd $(BUILD) && cpack >cpack.txt || { cat cpack.txt; exit 1; }
	@ls -l $(BUILD)/phyllite_*.deb
	@lintian --fail-on error,warning --suppress-tags $(UNNAMED) $(BUILD)/phyllite_*.deb

# Needs root, and a Debian mirror.
package-check: package
	@$(SUDO) bash packaging/check.sh $(BUILD)/phyllite_*.deb

demo: deps program
	$(BUILD)/phyllite calibrate examples/twin/twin.toml --out results/twin --resume

demo-press: deps program
	$(BUILD)/phyllite run examples/paper/press.toml --out results/paper

test: build
	@python3 tools/check_floors.py
	@ctest --test-dir $(BUILD) --output-on-failure -j $(JOBS) -LE 'bench|soak|paper'

deps-soak: deps
	@dpkg-query -W -f='$${Status}' python3-vtk9 2>/dev/null | grep -q 'ok installed' || \
	  DEBIAN_FRONTEND=noninteractive $(SUDO) apt-get install -y -qq --no-install-recommends python3-vtk9

soak: build
	@ctest --test-dir $(BUILD) --output-on-failure -L soak

bench: build
	PHY_BENCH_TESTS=1 $(BUILD)/bench_engine
	$(BUILD)/bench_statics
	$(BUILD)/bench_flat_joint

# The paper's studies into results/paper (resumed if they are there) and docs/paper.md from their stores. A study that holds
# a test without a peak ends with 1, which is a finding.
paper: build
	@for s in study no-jump small small-jump small-crossing crossing choices area; do f=study-$$s; [ $$s = study ] && f=study; \
	  $(BUILD)/phyllite study examples/paper/$$f.toml --out results/paper/$$s || [ $$? = 1 ] || exit 1; done
	@for s in elastic elastic-crossing elastic-area elastic-area-crossing; do \
	  $(BUILD)/phyllite study examples/paper/$$s.toml --out results/paper/$$s || [ $$? = 1 ] || exit 1; done
	rm -f docs/pictures/stiffness.png docs/pictures/modulus.png docs/pictures/strength.png # from the clone: not replaced
	for k in 4:stiffness 5:modulus 6:strength; do $(BUILD)/phyllite figure results/paper/study --kind fig$${k%%:*} \
	  --format png --out docs/pictures/$${k##*:}.png || exit 1; done
	python3 tools/paper.py results/paper docs

# Published results and closed forms of whole bodies beside ours: docs/evidence.md from the studies of examples/evidence, resumed
# if they are there. A study that holds a test without a peak ends with 1, which is a finding.
EVIDENCE := joint-patches joint-bonded joint-frictional joint-stiffness lac-du-bonnet-ucs lac-du-bonnet-bts lac-du-bonnet-jaws lac-du-bonnet-confined \
            resolution-ucs resolution-ucs-large resolution-ucs-largest resolution-fast resolution-bts resolution-bts-large speed time-step
evidence: program
	@for s in $(EVIDENCE); do $(BUILD)/phyllite study examples/evidence/$$s.toml --out results/evidence/$$s || [ $$? = 1 ] || exit 1; done
	@for p in 1 2 3 4 5; do f=results/evidence/joint-packing-$$p; sed "s/^n_grains.*/&\nseed = $$p/" examples/evidence/joint.toml > $$f.toml; \
	  $(BUILD)/phyllite specimen $$f.toml --out $$f || exit 1; done
	@for v in V25 V26 V27 V28 V29 V30; do $(BUILD)/phyllite verify $$v > results/evidence/$$v.txt || exit 1; done
	python3 tools/evidence.py results/evidence docs

# What models of rock reach: data/maps, which the program takes in, and docs/theory/reach.md. What the tables
# have is kept, without any some three and a half hours of CPU.
maps: build
	@cmake --build $(BUILD) --target maps && mkdir -p results
	$(BUILD)/maps data/maps results/maps.sqlite
	python3 tools/maps.py data/maps docs/theory/reach.md

# The paper's specimen here and in Yade (Debian: yade), one core each; takes some minutes, never part of CI.
bench-peers: build
	python3 bench/peers/run.py $(BUILD)/phyllite

# Yade with the laws of Phyllite on the same specimens (Debian: yade): bench/peers/equal.csv, which `make evidence` quotes. Tests that
# the table holds are not run again. Some twenty minutes of CPU, never part of CI.
yade: program
	python3 bench/peers/equal.py $(BUILD)/phyllite

# Tests made bad on purpose, and docs/reliability-tables.md from them. Some twelve minutes of CPU, never part of CI.
RELIABILITY := compression tension brazilian confined packing resolution shear poisson
reliability: program
	@for s in $(RELIABILITY); do $(BUILD)/phyllite study examples/reliability/$$s.toml --out results/reliability/$$s || [ $$? = 1 ] || exit 1; done
	python3 tools/reliability.py results/reliability docs/reliability-tables.md

# Studies over MPI ranks (Debian: libopenmpi-dev, openmpi-bin), built and tested beside the usual build.
mpi:
	@cmake -S . -B build/mpi -G Ninja -DPHY_MPI=ON -DPHY_BENCH=OFF >/dev/null
	@cmake --build build/mpi -j $(JOBS) --target phyllite test_x_mpi
	@ctest --test-dir build/mpi --output-on-failure -L mpi

# The same bits by another compiler.
clang-hash: deps-clang
	@cmake --preset clang >/dev/null && cmake --build build/clang -j $(JOBS) --target one_hash
	build/clang/one_hash --gtest_filter='GoldenHashes.*'

lint:
	@git ls-files '*.hpp' '*.cpp' | xargs clang-format --dry-run -Werror
	@python3 tools/check_floors.py
	@python3 tools/tools_test.py --quiet
	@python3 tools/check_functions.py
	@python3 tools/status.py --check
	@python3 tools/check_docs.py

# By the commands of a build without batches, which need not be run.
tidy:
	@cmake --preset release -B build/by-file -DPHY_BATCH=1 >/dev/null
	@git ls-files 'src/*.cpp' | grep -v '\.test\.' | xargs -P $(JOBS) -n 2 clang-tidy -p build/by-file --quiet 2>/dev/null

deps-clang: PACKAGES += clang libclang-rt-14-dev
deps-clang: deps

# Every reader of outside input (tests/fuzz/readers.hpp) for as many minutes of CPU; READERS="recipe rock" for some.
MINUTES := 10
fuzz: deps-clang
	@cmake --preset fuzz >/dev/null && cmake --build build/fuzz -j $(JOBS) --target fuzz
	@python3 tools/fuzz.py build/fuzz $(MINUTES) $(READERS)

# All tests of `make test` under address and undefined, then under thread those of the rooms that start threads. The
# library that counts events is loaded before the sanitizer's, which is meant.
THREADED := test_base test_statics test_study test_calibrate test_gui test_x_determinism
sanitize: asan
	@$(MAKE) --no-print-directory tsan
tsan: deps
	@cmake --preset tsan >/dev/null && cmake --build build/tsan -j $(JOBS) --target $(THREADED)
	@ctest --test-dir build/tsan --output-on-failure -j $(JOBS) -R '^($(subst $() ,|,$(THREADED)))$$'

asan: deps
	@cmake --preset asan >/dev/null && cmake --build build/asan -j $(JOBS)
	@find build/asan -name '*.gcda' -delete
	@ASAN_OPTIONS=verify_asan_link_order=0 ctest --test-dir build/asan --output-on-failure -j $(JOBS) -LE 'bench|soak|paper'

# Tests of the rooms that read, these rooms under address and undefined: what fits into continuous integration.
sanitize-short: deps
	@cmake -S . -B build/watched -G Ninja -DPHY_WATCH=ON -DPHY_BENCH=OFF -DPHY_PYTHON=OFF >/dev/null
	@cmake --build build/watched -j $(JOBS) --target test_base test_records test_io test_x_fuzz
	@ctest --test-dir build/watched --output-on-failure -j $(JOBS) -L watched

deps-coverage: PACKAGES += gcovr
deps-coverage: deps

# Lines that the last `make asan` ran.
coverage: deps-coverage
	@test -d build/asan || $(MAKE) asan
	@python3 tools/coverage.py build/asan

clang: deps-clang
	@cmake --preset clang >/dev/null && cmake --build build/clang -j $(JOBS)

# After a change that is meant to change bits: writes tests/recorded.txt anew and REASON into CHANGELOG.md.
record: build
	@python3 tools/record.py $(BUILD) "$(REASON)"

deps-docs: PACKAGES += $(SITE)
deps-docs: deps

# Pages that the program writes, then all as a site in build/site.
docs: deps-docs build
	($(BUILD)/phyllite recipe --reference; $(BUILD)/phyllite study --reference; $(BUILD)/phyllite rock --reference) > docs/reference.md
	$(BUILD)/phyllite rock --tables > docs/tables.md
	$(BUILD)/phyllite verify --markdown > docs/verification.md
	python3 tools/status.py
	@sphinx-build -q -W --keep-going -b html -c docs/site -d build/doctrees docs build/site
	@echo "docs: build/site/index.html, for any browser, without a network"

# The pages of report.html and of phyllite gui, bundled from web/src (web/report.html and web/gui.html are committed: building needs no node).
web:
	@cd web && npm ci --ignore-scripts --silent --no-audit --no-fund && npx tsc --noEmit && node build.mjs

# Both pages in Debian's Chromium; need node and chromium beside `make deps`.
browser: build web
	@PHYLLITE=$(BUILD)/phyllite node --test tests/browser/

clean:
	rm -rf build results
