# A sweep in shards, by GNU make, on one machine or on several that share a folder:
#     make -j 8 -f sweep.mk SWEEP='touch.scenario --vary "mass=60 g,75 g"' SHARDS=8 OUT=results.csv
# A shard that was killed goes on; the results are the bytes of one `firmtouch-sim sweep`. SIM names another program.
SIM ?= firmtouch-sim
SHARDS ?= 8
OUT ?= results.csv
shards := $(foreach i,$(shell seq $(SHARDS)),$(OUT).$(i).csv)

$(OUT): $(shards)
	$(SIM) merge $(shards) -o $@
# Always: a whole one is only read, one of another sweep is refused.
$(OUT).%.csv: always
	$(SIM) sweep $(SWEEP) --shard $*/$(SHARDS) --jobs 1 -o $@
.PHONY: always
