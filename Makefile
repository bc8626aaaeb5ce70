# buffon: build, tests, packaging. Needs GNU make, a C11 compiler and POSIX tools; `make help` lists
# the targets. CC, CFLAGS, CPPFLAGS and LDFLAGS reach every command.
#
# The library in another build: compile src/*.c with the headers of src/ and include/,
#
#     cc -std=c11 -O3 -ffp-contract=off -fno-math-errno -fno-trapping-math -Iinclude -c src/*.c
#
# and link with -lm -pthread. Only -ffp-contract=off bears on results, and src/guard.h sees to it
# where it is missing; -ffast-math is refused there. -DBUFFON_NO_THREADS leaves out threads,
# -DBUFFON_NO_VECTORS vector instructions; neither changes a bit of a result.

version_h = $(shell sed -n 's/^\#define $(1) "*\([0-9.]*\)"*$$/\1/p' include/buffon/version.h)
VERSION := $(call version_h,BUFFON_VERSION_STRING)
ABI := $(call version_h,BUFFON_ABI)

# ---- what a user may set ------------------------------------------------------------------------

BUILD ?= build
PREFIX ?= /usr/local
INCLUDEDIR ?= $(PREFIX)/include
LIBDIR ?= $(PREFIX)/lib
DESTDIR ?=
ifeq ($(origin CC),default)
CC := $(if $(shell command -v cc),cc,gcc)
endif
AR ?= ar
CFLAGS ?= -O3 -g
CPPFLAGS ?=
LDFLAGS ?=
WARNINGS ?= -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wstrict-prototypes
JOBS ?= $(shell getconf _NPROCESSORS_ONLN 2>/dev/null || echo 2)
# The test programs to run, the slow ones first; a command to run each under; how long to fuzz.
slow := test_stopping test_rng_stats test_coverage
TESTS ?= $(slow) $(filter-out $(slow),$(patsubst tests/%.c,%,$(wildcard tests/test_*.c \
                                                                        tests/fuzz_*.c)))
RUNNER ?=
FUZZ_SECONDS ?= 60
PKG_CONFIG ?= pkg-config

export BUILD CC CXX CFLAGS CPPFLAGS LDFLAGS WARNINGS MAKE PKG_CONFIG JOBS
# Tests ask for more memory than there is: under a sanitizer that is to fail as it does without.
export ASAN_OPTIONS ?= allocator_may_return_null=1
export TSAN_OPTIONS ?= allocator_may_return_null=1

# ---- what always holds --------------------------------------------------------------------------

# After the user's, so that they win. Results depend on -ffp-contract=off, speed on the next two.
flags = $(WARNINGS) -std=c11 -ffp-contract=off -fno-math-errno -fno-trapping-math \
        -fvisibility=hidden -pthread
compile = $(CC) -Iinclude $(CPPFLAGS) $(CFLAGS) $(flags) -MMD -MP
libraries = -lm -pthread

sources := $(sort $(wildcard src/*.c))
headers := $(sort $(wildcard include/buffon/*.h))
objects := $(sources:src/%.c=$(BUILD)/obj/%.o)
verified := $(sources:src/%.c=$(BUILD)/verify/%.o)
static := $(BUILD)/libbuffon.a
shared := $(BUILD)/libbuffon.so.$(VERSION)
tests := $(TESTS:%=$(BUILD)/tests/%)
checks := $(sort $(wildcard tests/check_*.sh))
# A file of examples/ is a program, and so is a directory.
example_files := $(sort $(wildcard examples/*.c))
example_trees := $(sort $(patsubst examples/%/,%,$(dir $(wildcard examples/*/*.c))))
examples := $(example_files:%.c=$(BUILD)/%) $(example_trees:%=$(BUILD)/examples/%)
benches := $(sort $(patsubst tests/bench/%.c,$(BUILD)/bench/%,$(wildcard tests/bench/*.c)))

# As many jobs as there are cores unless -j says otherwise.
ifeq ($(MAKELEVEL)$(filter -j%,$(MAKEFLAGS)),0)
MAKEFLAGS += -j$(JOBS)
endif

.DELETE_ON_ERROR:
.SUFFIXES:
.PHONY: all demo test unit check bits cross bench bench-peers battery docs amalgamation install \
        uninstall dist asan tsan ubsan memcheck coverage fuzz programs examples clean help force

all: $(static) $(shared) ## the static and the shared library, in build/

# ---- the library --------------------------------------------------------------------------------

# Changes when the compiler or a flag does, and every object with it; when the list of sources does,
# and the libraries.
$(BUILD)/flags: force
	@mkdir -p $(@D)
	@printf '%s\n' "$$CC" "$$CPPFLAGS" "$$CFLAGS" "$$LDFLAGS" '$(flags)' > $@.new
	@$(CC) --version >> $@.new
	@if cmp -s $@.new $@; then rm $@.new; else mv $@.new $@; fi
$(BUILD)/sources: force
	@mkdir -p $(@D)
	@printf '%s\n' '$(sources)' > $@.new
	@if cmp -s $@.new $@; then rm $@.new; else mv $@.new $@; fi

# One set of objects for both libraries: position-independent code costs next to nothing.
$(BUILD)/obj/%.o: src/%.c $(BUILD)/flags
	@mkdir -p $(@D)
	@echo "  CC    $<"
	@$(compile) -fPIC -c -o $@ $<

# With the invariants of src/verify.h checked: what the tests link.
$(BUILD)/verify/%.o: src/%.c $(BUILD)/flags
	@mkdir -p $(@D)
	@echo "  CC    $< (verify)"
	@$(compile) -DBUFFON_VERIFY -c -o $@ $<

$(static): $(objects) $(BUILD)/sources
$(BUILD)/verify/libbuffon.a: $(verified) $(BUILD)/sources
$(static) $(BUILD)/verify/libbuffon.a:
	@echo "  AR    $@"
	@rm -f $@
	@$(AR) rcs $@ $(filter %.o,$^)

$(shared): $(objects) $(BUILD)/sources
	@echo "  LINK  $@"
	@$(CC) $(CFLAGS) -shared -Wl,-soname,libbuffon.so.$(ABI) $(LDFLAGS) -o $@ $(objects) \
	  $(libraries)
	@ln -sf $(@F) $(BUILD)/libbuffon.so.$(ABI)
	@ln -sf $(@F) $(BUILD)/libbuffon.so

# ---- programs -----------------------------------------------------------------------------------

# $(call program,flags,libraries): compiles and links one.
define program
@mkdir -p $(@D)
@echo "  CC    $@"
@$(compile) -MF $@.d -MT $@ $(1) $(LDFLAGS) -o $@ $(filter %.c %.a,$^) $(2) $(libraries)
endef

# These tests stand between the library and the system.
wrap = $(1:%=-Wl,--wrap=%)
wrap_test_faults = $(call wrap,malloc calloc free pthread_create clock_gettime)
wrap_test_engine = $(call wrap,clock_gettime)
wrap_test_failures = $(call wrap,clock_gettime)
wrap_test_progress = $(call wrap,clock_gettime)
wrap_bench = $(call wrap,malloc calloc free)

$(BUILD)/tests/%: tests/%.c $(BUILD)/verify/libbuffon.a
	$(call program,-Isrc $(wrap_$*))

# These use what is installed, not the private parts, and measure it or print its bits.
$(BUILD)/tests/bits: tests/bits.c $(static)
	$(call program)
$(BUILD)/tests/battery: tests/battery.c $(static)
	$(call program)

$(BUILD)/bench/%: tests/bench/%.c $(static) $(BUILD)/peers
	$(call program,$(peers) $(wrap_$*),$(peer_libraries))

$(BUILD)/examples/%: examples/%.c $(static)
	$(call program)

define example_tree
$(BUILD)/examples/$(1): $(patsubst %.c,$(BUILD)/obj/%.o,$(wildcard examples/$(1)/*.c))
endef
$(foreach tree,$(example_trees),$(eval $(call example_tree,$(tree))))
# The gallery draws with what the lecture draws with.
$(BUILD)/examples/gallery: $(patsubst %,$(BUILD)/obj/examples/lecture/%.o,text figure globe)
$(BUILD)/obj/examples/%.o: examples/%.c $(BUILD)/flags
	@mkdir -p $(@D)
	@echo "  CC    $<"
	@$(compile) -c -o $@ $<
$(example_trees:%=$(BUILD)/examples/%): $(static)
	@mkdir -p $(@D)
	@echo "  LINK  $@"
	@$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $(filter %.o,$^) $(static) $(libraries)

# What takes no part in `make test` is compiled all the same.
programs: $(tests) $(examples) $(benches) $(BUILD)/tests/bits $(BUILD)/tests/battery ## all of them

examples: $(examples) ## the programs of examples/, in build/examples/

demo: $(BUILD)/examples/lecture $(BUILD)/examples/gallery ## build/demo/lecture.html, gallery.html
	@mkdir -p $(BUILD)/demo
	@$(BUILD)/examples/lecture $(BUILD)/demo/lecture.html
	@$(BUILD)/examples/gallery $(BUILD)/demo/gallery.html

# ---- tests --------------------------------------------------------------------------------------

run_tests = sh tests/run.sh -j $(JOBS) -o $(BUILD)/tests

test: all examples $(tests) ## all tests and the cheap checks; the last line counts them
	@$(run_tests) $(checks) $(tests)

unit: $(tests) ## the test programs alone: make unit TESTS='test_rng test_stats'
	@$(run_tests) -w '$(RUNNER)' $(tests)

check: test ## the tests, and bits
	@$(MAKE) --no-print-directory bits

bits: ## the same bits from every compiler and level of optimisation here
	@sh tests/bits.sh

cross: ## bits and exact tests on other processors: ARM, s390x, 32-bit x86
	@sh tests/cross.sh

battery: $(BUILD)/tests/battery ## dieharder over interleaved streams: hours
	@sh tests/battery.sh $(BUILD)/tests/battery

asan: ## the test programs with the address sanitizer
	@$(MAKE) --no-print-directory unit BUILD=$(BUILD)/asan \
	  CFLAGS='-O2 -g -fno-omit-frame-pointer -fsanitize=address -fno-sanitize-recover=all'

ubsan: ## the test programs with the undefined behaviour sanitizer
	@$(MAKE) --no-print-directory unit BUILD=$(BUILD)/ubsan \
	  CFLAGS='-O2 -g -fsanitize=undefined -fno-sanitize-recover=all'

# The sanitizer of older compilers does not find its way about the address space of newer kernels
# while that is laid out at random.
tsan: ## the test programs with the thread sanitizer
	@$(MAKE) --no-print-directory unit BUILD=$(BUILD)/tsan \
	  RUNNER="$$(setarch -R true 2>/dev/null && echo setarch -R)" \
	  CFLAGS='-O2 -g -fsanitize=thread'

memcheck: ## the test programs under valgrind
	@$(MAKE) --no-print-directory unit \
	  RUNNER='valgrind -q --leak-check=full --show-leak-kinds=all --error-exitcode=99'

coverage: ## lines of the library that the tests reach
	@$(MAKE) --no-print-directory unit BUILD=$(BUILD)/coverage \
	  CFLAGS='-O0 -g --coverage -fprofile-update=atomic'
	@gcov -n -o $(BUILD)/coverage/verify $(sources) | \
	  awk -F"[':%]" '/^File/ { file = $$2 } \
	    /^Lines/ && file ~ /^src/ { print $$2 "%  " file; file = "" }'

# Each target is also one of the tests, where it makes its own bytes; the good ones are the seeds.
# Bytes that are read do not come near a kernel, so those are compiled once, not for each level.
fuzz: $(filter $(BUILD)/tests/fuzz_%,$(tests)) ## the fuzz targets, FUZZ_SECONDS each, by libFuzzer
	@mkdir -p $(BUILD)/fuzz
	@for file in tests/fuzz_*.c; do \
	   name=$$(basename $$file .c); mkdir -p $(BUILD)/fuzz/corpus_$$name; \
	   $(BUILD)/tests/$$name $(BUILD)/fuzz/corpus_$$name > $(BUILD)/fuzz/$$name.tap || exit 1; \
	   clang -g -O1 -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all \
	     -DBUFFON_LIBFUZZER -DBUFFON_NO_VECTORS -DBUFFON_VERIFY -Iinclude -Isrc $(CPPFLAGS) \
	     $(flags) $$file $(sources) \
	     -o $(BUILD)/fuzz/$$name $(libraries) && \
	   $(BUILD)/fuzz/$$name -max_total_time=$(FUZZ_SECONDS) -max_len=65536 -verbosity=0 \
	     -print_final_stats=1 -artifact_prefix=$(BUILD)/fuzz/ $(BUILD)/fuzz/corpus_$$name || exit 1; \
	 done

# ---- benches ------------------------------------------------------------------------------------

# Libraries to compare with, asked for only where a bench is built. $(call links,header,libraries):
# does a program with these?
gsl = $(eval gsl := $(shell $(PKG_CONFIG) --libs gsl 2>/dev/null))$(gsl)
gsl_cflags = $(shell $(PKG_CONFIG) --cflags gsl)
dsfmt = $(eval dsfmt := $(call links,dSFMT.h,-ldSFMT))$(dsfmt)
random123 = $(eval random123 := $(call links,Random123/philox.h))$(random123)
unuran = $(eval unuran := $(call links,unuran.h,-lunuran -lm))$(unuran)
links = $(shell mkdir -p $(BUILD); echo 'int main(void) { return 0; }' | \
          $(CC) $(CPPFLAGS) $(LDFLAGS) -include $(1) -x c - -x none -o $(BUILD)/links $(2) \
          2>/dev/null && echo yes)
peers = $(if $(gsl),-DBENCH_GSL $(gsl_cflags)) $(if $(dsfmt),-DBENCH_DSFMT) \
        $(if $(random123),-DBENCH_RANDOM123) $(if $(unuran),-DBENCH_UNURAN)
peer_libraries = $(gsl) $(if $(dsfmt),-ldSFMT) $(if $(unuran),-lunuran)

# Changes when a library comes or goes.
$(BUILD)/peers: force
	@mkdir -p $(@D)
	@echo '$(strip $(peers))' > $@.new
	@if cmp -s $@.new $@; then rm $@.new; else mv $@.new $@; fi

bench: $(benches) ## ns per number, point and evaluation; against other libraries installed
	@for program in $^; do $$program || exit 1; done

bench-peers: ## the same, and an error where GSL is not installed
	@test -n '$(gsl)' || { echo "GSL is not installed: pkg-config does not find gsl"; exit 1; }
	@$(MAKE) --no-print-directory bench

# ---- documentation and packaging ----------------------------------------------------------------

docs: $(BUILD)/docs/reference.md ## the reference, from the comments of the headers
$(BUILD)/docs/reference.md: docs/reference.awk $(headers)
	@mkdir -p $(@D)
	@echo "  DOCS  $@"
	@awk -f docs/reference.awk include/buffon/buffon.h > $@

one_file := $(BUILD)/amalgamation/buffon.c $(BUILD)/amalgamation/buffon.h

amalgamation: $(one_file) ## the library as one source and one header, in build/amalgamation/
$(BUILD)/amalgamation/buffon.c: parts = $(sources)
$(BUILD)/amalgamation/buffon.h: parts = include/buffon/buffon.h
$(one_file): src/amalgamation.awk LICENSE $(sources) $(headers) $(wildcard src/*.h)
	@mkdir -p $(@D)
	@echo "  JOIN  $@"
	@awk -v version=$(VERSION) -f $< $(parts) > $@

below_prefix = $(patsubst $(PREFIX)/%,$${prefix}/%,$(1))

install: all ## into DESTDIR PREFIX, LIBDIR and INCLUDEDIR (/usr/local)
	@mkdir -p '$(DESTDIR)$(INCLUDEDIR)/buffon' '$(DESTDIR)$(LIBDIR)/pkgconfig'
	@install -m 644 $(headers) '$(DESTDIR)$(INCLUDEDIR)/buffon'
	@install -m 644 $(static) '$(DESTDIR)$(LIBDIR)'
	@install -m 755 $(shared) '$(DESTDIR)$(LIBDIR)'
	@ln -sf $(notdir $(shared)) '$(DESTDIR)$(LIBDIR)/libbuffon.so.$(ABI)'
	@ln -sf $(notdir $(shared)) '$(DESTDIR)$(LIBDIR)/libbuffon.so'
	@printf '%s\n' 'prefix=$(PREFIX)' 'libdir=$(call below_prefix,$(LIBDIR))' \
	  'includedir=$(call below_prefix,$(INCLUDEDIR))' '' 'Name: buffon' \
	  'Description: Monte Carlo integration and sampling' 'Version: $(VERSION)' \
	  'Libs: -L$${libdir} -lbuffon' 'Libs.private: -lm -pthread' 'Cflags: -I$${includedir}' \
	  > '$(DESTDIR)$(LIBDIR)/pkgconfig/buffon.pc'

uninstall: ## removes what install put there
	@rm -f $(headers:include/%='$(DESTDIR)$(INCLUDEDIR)/%') '$(DESTDIR)$(LIBDIR)/libbuffon.a' \
	  '$(DESTDIR)$(LIBDIR)/libbuffon.so.$(VERSION)' '$(DESTDIR)$(LIBDIR)/libbuffon.so.$(ABI)' \
	  '$(DESTDIR)$(LIBDIR)/libbuffon.so' '$(DESTDIR)$(LIBDIR)/pkgconfig/buffon.pc'
	@if [ -d '$(DESTDIR)$(INCLUDEDIR)/buffon' ]; then rmdir '$(DESTDIR)$(INCLUDEDIR)/buffon'; fi

dist: ## the committed sources as build/buffon-VERSION.tar.gz
	@mkdir -p $(BUILD)
	@git archive --prefix=buffon-$(VERSION)/ -o $(BUILD)/buffon-$(VERSION).tar.gz HEAD
	@echo $(BUILD)/buffon-$(VERSION).tar.gz

clean: ## removes build/
	@rm -rf $(BUILD)

help: ## this list
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "%-12s %s\n", $$1, $$2 }' Makefile

-include $(foreach dir,obj obj/examples/* verify tests bench examples, \
           $(wildcard $(BUILD)/$(dir)/*.d))
