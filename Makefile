# Two commands: `make demo` shows what Boxwood does, `make test` proves it. Both install what is missing (Debian 12).
.DEFAULT_GOAL := help
RELEASE := build
# All sources of a room in few files, which halves the time; while working on one, configure without.
CONFIGURE := cmake -G Ninja -S . -DBOXWOOD_UNITY=ON
# Sanitized builds: quick to compile, quick enough to run, with assertions.
SANITIZED := -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O1 -DBOXWOOD_EXAMPLES=OFF
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

demo: build ## Compare acceleration structures on a scanned mesh and a procedural scene; ends with pictures and a report
	@scripts/demo.sh $(RELEASE)/boxwood out/demo

test: test-release ## The whole test suite
	@scripts/test-summary.sh $(RELEASE)/Testing

test-release: build
	@ctest --test-dir $(RELEASE) -j$(THREADS) --output-on-failure --output-junit Testing/junit.xml --progress

test-sanitized: deps ## The whole test suite under ASan+UBSan
	@$(CONFIGURE) -B build/asan $(SANITIZED) -DBOXWOOD_SANITIZE=address,undefined >/dev/null
	@cmake --build build/asan
	@ctest --test-dir build/asan -j$(THREADS) --output-on-failure --output-junit Testing/junit.xml --progress

# One structure, image or answer on any number of threads, and one structure asked by many.
THREADED := build fastbuild pca octree structure heuristics moving distance render measure limits custom placing
test-threads: ## Builders, batches, renderers, and queries from many threads, under the thread sanitizer
	@scripts/install-packages.sh dpkg-dev
	@scripts/instrumented-tbb.sh build/tsan-tbb
	@$(CONFIGURE) -B build/tsan $(SANITIZED) -DBOXWOOD_SANITIZE=thread -DBOXWOOD_APPS=OFF -DTBB_DIR=$(CURDIR)/build/tsan-tbb/lib/cmake/TBB >/dev/null
	@cmake --build build/tsan --target $(THREADED:%=test_%)
	@ctest --test-dir build/tsan -R 'AnyNumberOfThreads|ConcurrentQueries' --no-tests=error -j$(THREADS) --output-on-failure --output-junit Testing/junit.xml --progress

bench: build ## Build and trace speed as ratios to Embree 3, in one run
	@$(RELEASE)/boxwood bench --peer embree

check-format: ## Fail on a source that clang-format would change
	@scripts/install-packages.sh clang-format clang-tidy
	@git ls-files '*.cpp' '*.h' | xargs clang-format --dry-run -Werror

# The files that unity builds make, so that headers are read once for many sources.
lint: build check-format ## clang-format and clang-tidy over everything
	@run-clang-tidy -p $(RELEASE) -quiet -j $(THREADS) -extra-arg=-Wno-unknown-warning-option '^(?!.*/(tests|examples|python)/)' > $(RELEASE)/lint.txt 2> $(RELEASE)/lint.log \
	  && echo "clang-tidy finds nothing" || (cat $(RELEASE)/lint.txt; exit 1)

format: ## Rewrite all sources in the house format
	@git ls-files '*.cpp' '*.h' | xargs clang-format -i

docs: build ## Regenerate docs/recipes.md from the registry
	@$(RELEASE)/boxwood recipes --markdown > docs/recipes.md

pictures: build ## Render the pictures of the README anew
	@scripts/pictures.sh $(RELEASE)/boxwood docs/images

install: build ## Install the library, its headers and the CMake package
	@cmake --install $(RELEASE)

clean: ## Remove everything that was built
	rm -rf build out

.PHONY: help deps build demo test test-release test-sanitized test-threads bench lint check-format format docs pictures install clean
