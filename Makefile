# Two commands: `make demo` shows what Boxwood does, `make test` proves it. Both install what is missing (Debian 12).
.DEFAULT_GOAL := help
RELEASE := build
CONFIGURE := cmake -G Ninja -S .
THREADS := $(shell nproc)
# Lets ccache recognise the same sources in another folder.
export CCACHE_BASEDIR := $(CURDIR)
export CCACHE_NOHASHDIR := 1

help: ## This list
	@grep -hE '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/^([a-z-]+):.*## /  make \1\t/' | expand -t 18

deps: ## Install the Debian packages that are missing
	@scripts/install-packages.sh

build: deps ## Build the program and the library (Release) into build/
	@$(CONFIGURE) -B $(RELEASE) -DCMAKE_BUILD_TYPE=Release >/dev/null
	@cmake --build $(RELEASE)

demo: build ## Compare acceleration structures on a scanned mesh and a procedural scene
	@scripts/demo.sh $(RELEASE)/boxwood out/demo

test: test-release test-sanitized test-threads ## The whole test suite: Release, ASan+UBSan, TSan
	@scripts/test-summary.sh build/Testing build/asan/Testing build/tsan/Testing

test-release: build
	@ctest --test-dir $(RELEASE) -j$(THREADS) --output-on-failure --output-junit Testing/junit.xml --progress

test-sanitized: deps
	@$(CONFIGURE) -B build/asan -DCMAKE_BUILD_TYPE=RelWithDebInfo -DBOXWOOD_SANITIZE=address,undefined -DBOXWOOD_EXAMPLES=OFF >/dev/null
	@cmake --build build/asan
	@ctest --test-dir build/asan -j$(THREADS) --output-on-failure --output-junit Testing/junit.xml --progress

test-threads: deps
	@$(CONFIGURE) -B build/tsan -DCMAKE_BUILD_TYPE=RelWithDebInfo -DBOXWOOD_SANITIZE=thread -DBOXWOOD_APPS=OFF -DBOXWOOD_EXAMPLES=OFF >/dev/null
	@cmake --build build/tsan --target test_build
	@TSAN_OPTIONS="suppressions=$(CURDIR)/tests/tsan.supp" ctest --test-dir build/tsan -R 'Thread' -j$(THREADS) --output-on-failure --output-junit Testing/junit.xml --progress

bench: build ## Build and trace speed as ratios to Embree 3, in one run
	@$(RELEASE)/boxwood bench --peer embree

lint: build ## clang-format and clang-tidy over everything
	@scripts/install-packages.sh --lint
	@scripts/lint.sh $(RELEASE)

format: ## Rewrite all sources in the house format
	@git ls-files '*.cpp' '*.h' | xargs clang-format -i

docs: build ## Regenerate docs/recipes.md from the registry
	@$(RELEASE)/boxwood recipes --markdown > docs/recipes.md

install: build ## Install the library, its headers and the CMake package
	@cmake --install $(RELEASE)

clean: ## Remove everything that was built
	rm -rf build out

.PHONY: help deps build demo test test-release test-sanitized test-threads bench lint format docs install clean
