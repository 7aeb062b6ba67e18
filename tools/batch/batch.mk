# A batch in shards, by GNU make, on one machine or on several that share a folder:
#     make -j 8 -f batch.mk RUN='firmtouch-sim sweep touch.scenario --vary "mass=60 g,75 g"' SHARDS=8 OUT=results.csv
#     make -j 8 -f batch.mk RUN='firmtouch bake --catalogue parts.txt' SHARDS=8 OUT=results.csv
# A shard that was killed goes on; the results are the bytes of one run. SIM names another firmtouch-sim.
SIM ?= firmtouch-sim
SHARDS ?= 8
OUT ?= results.csv
shards := $(foreach i,$(shell seq $(SHARDS)),$(OUT).$(i).csv)

$(OUT): $(shards)
	$(SIM) merge $(shards) -o $@
# Always: a whole one is only read, one of another batch is refused. 1: an asset of a catalogue was refused.
$(OUT).%.csv: always
	$(RUN) --shard $*/$(SHARDS) --jobs 1 -o $@ || test $$? = 1
.PHONY: always
