# SPDX-License-Identifier: Apache-2.0
# Short names for the usual work; everything is in CMake. `make help` lists them.
.PHONY: help demo build without-page deb test test-all formal paper growth ablation datasheets bench fuzz attack asan ubsan tsan clang dependencies format clean
.DEFAULT_GOAL := help
# Several sources are compiled as one: half the time of a whole build.
WHOLE := -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=60
CONFIGURE := cmake --preset release -DREGULUS_TESTS=OFF $(WHOLE) >build-configure.log 2>&1 || \
	{ cat build-configure.log; rm -f build-configure.log; exit 1; }; rm -f build-configure.log

help:           ## this list
	@sed -n 's/^\([a-z-]*\):[^#]*## /\1\t/p' Makefile | expand -t 16

demo: without-page  ## install what is missing, build, certify two robots
	@cmake --build --preset release --target regulus
	build/bin/regulus check models/robot_1.toml wide_15
	build/bin/regulus check models/robot_2.toml table5_30

build: dependencies  ## the command, at build/bin/regulus, and all that is installed with it
	@$(CONFIGURE)
	@cmake --build --preset release

# Nothing but Debian's packages is fetched for the command alone.
without-page:
	@cmake/install-dependencies.sh --without-page
	@$(CONFIGURE)

deb: build      ## Debian packages of the command and of the library: build/*.deb
	@cmake/install-dependencies.sh dpkg-dev file
	cd build && cpack -G DEB

test: dependencies   ## the fast tests
	cmake --preset release -DREGULUS_TESTS=ON -DREGULUS_SLOW_TESTS=OFF $(WHOLE)
	cmake --build --preset release
	ctest --preset release

test-all: dependencies  ## every test, the slow ones and ThreadSanitizer's too
	@cmake/install-dependencies.sh g++-aarch64-linux-gnu qemu-user-static dpkg-dev file chromium || echo "Tests that need them are left out."
	cmake --preset release -DREGULUS_TESTS=ON -DREGULUS_SLOW_TESTS=ON $(WHOLE)
	cmake --build --preset release
	ctest --preset all
	$(MAKE) tsan

formal: dependencies  ## verdicts as theorems that Coq proves: tests/formal/RESULTS.md
	@cmake/install-dependencies.sh coq libcoq-interval libcoq-flocq ocaml-nox
	cmake --preset release -DREGULUS_TESTS=ON
	cmake --build --preset release --target formal regulus regulus-verify
	ctest --test-dir build -R '^formal\.' --output-on-failure
	cp build/tests/formal/proofs/RESULTS.md tests/formal/RESULTS.md
	@cat tests/formal/RESULTS.md

LIMIT ?= 10
paper: dependencies  ## the paper's Tables IV-VII, run again: tests/paper/RESULTS.md (LIMIT seconds a cell)
	cmake --preset release -DREGULUS_TESTS=ON
	cmake --build --preset release --target paper_tables
	build/bin/paper_tables $(LIMIT) >build/RESULTS.md
	mv build/RESULTS.md tests/paper/RESULTS.md
	@cat tests/paper/RESULTS.md

growth: dependencies  ## boxes by tolerance, range and gap: tests/paper/GROWTH.md and two pictures (LIMIT seconds a cell)
	cmake --preset release -DREGULUS_TESTS=ON
	cmake --build --preset release --target growth_tables
	build/bin/growth_tables build/growth.svg build/bound_growth.svg $(LIMIT) >build/GROWTH.md
	mv build/GROWTH.md build/growth.svg build/bound_growth.svg tests/paper/

ablation: dependencies  ## what each ingredient contributes: tests/paper/ABLATION.md (LIMIT seconds a cell)
	cmake --preset release -DREGULUS_TESTS=ON
	cmake --build --preset release --target ablation_tables
	build/bin/ablation_tables $(LIMIT) >build/ABLATION.md
	mv build/ABLATION.md tests/paper/ABLATION.md

datasheets: build  ## forces, speeds and accuracy of some robots: models/DATASHEETS.md (five minutes)
	models/write-datasheets.sh $(CURDIR)/build/bin/regulus >build/DATASHEETS.md
	mv build/DATASHEETS.md models/DATASHEETS.md

bench: dependencies  ## what it costs, and what others cost: tests/bench/RESULTS.md, build/bench.json
	@cmake/install-dependencies.sh libboost-dev libmpfi-dev valgrind || echo "Rows that need what is missing will say so."
	cmake --preset release -DREGULUS_TESTS=ON -DREGULUS_BENCH=ON
	cmake --build --preset release --target bench
	build/bin/bench --json build/bench.json --markdown build/BENCH.md
	mv build/BENCH.md tests/bench/RESULTS.md

SECONDS ?= 60
fuzz: dependencies  ## every parser of foreign files, SECONDS each, from tests/fuzz/corpus
	cmake --preset fuzz
	cmake --build --preset fuzz
	tests/fuzz/run.sh build-fuzz $(SECONDS)

tsan: dependencies  ## every test that runs several threads, under ThreadSanitizer
	cmake --preset tsan
	cmake --build --preset tsan
	ctest --preset tsan

MODELS ?= 100000
attack: dependencies  ## MODELS hostile models and forged proofs, judged by what is known of them: build/attack.json, forge.json
	cmake --preset release -DREGULUS_TESTS=ON
	cmake --build --preset release --target attack forge
	build/bin/forge --forgeries $(MODELS) --json build/forge.json
	build/bin/attack --models $(MODELS) --fail-on-slow --least-verified 99 --json build/attack.json

asan ubsan clang: dependencies  ## the fast tests under that preset
	cmake --preset $@
	cmake --build --preset $@
	ctest --preset $@

dependencies:   ## install the packages that are missing (Debian)
	@cmake/install-dependencies.sh

format:         ## clang-format every source file
	git ls-files '*.cpp' '*.hpp' '*.h' ':!generated' | xargs clang-format -i

clean:          ## remove every build folder
	rm -rf build build-dev build-clang build-asan build-ubsan build-tsan build-fuzz
