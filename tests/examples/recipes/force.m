% MATLAB and Octave: the largest force of a log, and when.
%     LOG=run.ftl octave force.m        or setenv("LOG", "run.ftl"); force in MATLAB
log = getenv("LOG");
fields = "input.clock_us,output.force_N";  % `firmtouch log run.ftl info` lists all
system(sprintf("firmtouch log %s csv --fields %s -o force.csv", log, fields));
rows = dlmread("force.csv", ",", 1, 0);    % behind the header
force = sqrt(sum(rows(:, 2:4) .^ 2, 2));
[most, tick] = max(force);
printf("largest force %.6f N at %.3f s\n", most, rows(tick, 1) * 1e-6);
% plot(rows(:, 1) * 1e-6, force), xlabel("s"), ylabel("N")
